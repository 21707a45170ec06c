// Matroska's StereoMode, for values that libavformat does not write.
#pragma once

#include <filesystem>

namespace stereonav {

// libavformat 59 writes no value for anaglyphs (10, 12). It is given that of a checkerboard, which changes
// nothing else in the file, and the value is replaced in the finished file. Checksums have to be left out.
constexpr int kStandInStereoMode = 5;
constexpr bool needsStandIn(int stereoMode) {
    return stereoMode == 10 || stereoMode == 12;
}

// Returns false where the file can not be read or written, or does not have the stand-in.
bool replaceStandIn(const std::filesystem::path& file, int stereoMode);

}  // namespace stereonav
