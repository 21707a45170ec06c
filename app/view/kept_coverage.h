// What was flown while coverage was on, kept for the scene's file: the pictures that the wall is looked at
// from. What they show is worked out again when it is switched on, so another distance, or a wall that was
// found otherwise, needs nothing else.
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

// Where that of a scene is kept whose places are kept in that file (Bookmarks::file()); "" for "".
std::filesystem::path coverageFile(const std::filesystem::path& places);

// To a hundredth of a millimetre and 1e-5 of angles. Throws Error as writeKept.
void writeFlown(const std::filesystem::path& file, const FlownWay& flown);

// Nothing flown where there is no such file, or where it is damaged: then it is set aside, and `problem` says
// so.
FlownWay readFlown(const std::filesystem::path& file, std::string& problem);

}  // namespace stereonav
