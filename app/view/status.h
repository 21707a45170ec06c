// What the viewer's lines of text say of a frame.
#pragma once

#include <string>

#include "app/view/worker.h"
#include "engine/stereo/comfort.h"

namespace stereonav {

// Times, holes, method and stereo setting of a frame. framesPerSecond: 0 while it is not known.
std::string frameText(const ViewFrame& frame, double framesPerSecond);

// For a meter of the frame's parallax. Its bars are ViewFrame::parallax.
struct ComfortReading {
    double near = 0, far = 0, range = 0;  // shares of the picture's width
    ComfortState state = ComfortState::Comfortable;
    std::string advice;  // "" where it is comfortable
};
// One eye is comfortable.
ComfortReading comfortReading(const ViewFrame& frame);

// Advice where the parallax of the frame is too much, else "".
std::string warningLine(const ViewFrame& frame);

// "error 52.3 dB, 41 of 255 at most, in 6.1 % of the right eye", or why that is not known.
std::string truthText(const FrameTruth& truth);

}  // namespace stereonav
