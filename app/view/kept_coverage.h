// The flight while coverage was on, kept for the scene's file: the views from which the wall was seen.
// Coverage is computed again from them when it is switched on, so that another distance, or a wall that was
// found differently, needs nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/camera/eye_view.h"

namespace stereonav {

struct FlownWay {
    static constexpr std::size_t kMost = 100000;  // eyes: 150 m at 1.5 mm, 8 MB of file

    std::vector<EyeView> eyes;  // without sizes in pixels
    double metres = 0, seconds = 0;
};

// Writes with a precision of a hundredth of a millimetre, and 1e-5 for angles. Throws Error like writeKept.
void writeFlown(const std::filesystem::path& file, const FlownWay& flown);

// Returns no flight where there is no such file, or it is damaged: then it is set aside, and `problem` says
// so.
FlownWay readFlown(const std::filesystem::path& file, std::string& problem);

}  // namespace stereonav
