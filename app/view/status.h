// What the viewer's lines of text say of a frame.
#pragma once

#include <string>

#include "app/view/worker.h"

namespace stereonav {

// Times, holes, method and stereo setting of a frame. framesPerSecond: 0 while it is not known.
std::string frameText(const ViewFrame& frame, double framesPerSecond);

// "" while the parallax of the frame is comfortable.
std::string warningLine(const ViewFrame& frame);

}  // namespace stereonav
