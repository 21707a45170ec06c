// Charts as pictures, drawn with OpenCV.
#pragma once

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/metrics/chart_drawing.h"

namespace stereonav {

// Returns the charts dark on white, 760 pixels for each of the usual width. Throws Error.
Plane<PackedColor> chartPicture(const ChartDrawing& drawing);

}  // namespace stereonav
