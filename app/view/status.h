// What the viewer's lines of text say of a frame.
#pragma once

#include <string>

#include "app/view/worker.h"

namespace stereonav {

// Metres in the unit that suits the size: "1.3 mm", "20.0 m", "1.25 km".
std::string lengthText(double metres);

// Times, holes, method and stereo setting of a frame. framesPerSecond: 0 while it is not known.
std::string frameText(const ViewFrame& frame, double framesPerSecond);

// "" while the parallax of the frame is comfortable.
std::string warningLine(const ViewFrame& frame);

}  // namespace stereonav
