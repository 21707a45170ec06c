// The status bar in words, for who looks at the picture; and in figures, for who looks at the program.
#pragma once

#include <optional>
#include <string>

#include "app/view/view_frame.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

// A picture that is warped to where the eyes are now.
struct LatePicture {
    double age_s = 0;  // since it was asked for
    double scale = 1;  // share of the width and height in which it was cast
};

// Returns "coarse while it moves", "catching up", or "" where nobody would notice.
std::string lateWords(const LatePicture& late);
// Returns "669 ms old, 29 %".
std::string lateFigures(const LatePicture& late);

// Returns how the picture that rests compares with the truth: "refined", "both eyes exact". measured: the
// figures of ViewSession::measuredText(); "" returns "". truth: of the right eye, where `frame` is not
// refined.
std::string truthWords(const ViewFrame& frame, const FrameTruth& truth, const std::string& measured);

// Returns the eyes' times; that of the right eye only where it is shown.
std::string costFigures(const ViewFrame& frame, OutputLayout layout);

}  // namespace stereonav
