// Matroska's StereoMode, as far as libavformat does not write it.
#pragma once

#include <filesystem>

namespace stereonav {

// libavformat 59 writes no anaglyph's value (10, 12): it is told the one of a checkerboard, which changes
// nothing else in the file, and that one is replaced in the file that is complete. Checksums must be left
// out.
constexpr int kStandInStereoMode = 5;
constexpr bool needsStandIn(int stereoMode) {
    return stereoMode == 10 || stereoMode == 12;
}

// False where the file can not be read or written, or does not have the stand-in.
bool replaceStandIn(const std::filesystem::path& file, int stereoMode);

}  // namespace stereonav
