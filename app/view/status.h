// Texts of the viewer's status bar about a frame.
#pragma once

#include <string>

#include "app/view/view_frame.h"
#include "engine/stereo/comfort.h"

namespace stereonav {

// Returns times, holes, method and stereo setting of a frame. framesPerSecond: 0 while it is not known.
std::string frameText(const ViewFrame& frame, double framesPerSecond);

// Values for the meter of the frame's parallax. ViewFrame::parallax has its bars.
struct ComfortReading {
    double near = 0, far = 0, range = 0;  // shares of the picture's width
    ComfortState state = ComfortState::Comfortable;
    std::string advice;  // "" where it is comfortable
};
// One eye is always comfortable.
ComfortReading comfortReading(const ViewFrame& frame);

// Returns advice where the frame's parallax is too large, else "".
std::string warningLine(const ViewFrame& frame);

// Returns "error 52.3 dB, 41 of 255 at most, in 6.1 % of the right eye", or why it is not known.
std::string truthText(const FrameTruth& truth);

}  // namespace stereonav
