// Stereo tags of video files, by which players show both eyes without further settings: one table from output
// modes to the values of Matroska, MP4 and H.264.
#pragma once

#include "engine/image/stereo_compose.h"

namespace stereonav {

enum class VideoKind {
    Mp4,  // H.264
    Avi,  // Motion JPEG
    Mkv,  // FFV1, lossless
};

// Passed to the module stereonav_video: plain numbers, -1 where there is no value.
struct StereoTag {
    int matroska = -1;      // StereoMode, RFC 9559, 5.1.4.1.28.3
    int st3d = -1;          // MP4's box: 0 one eye, 1 top-bottom, 2 side by side; the left eye first
    int framePacking = -1;  // H.264's message (SEI): 0 checkerboard, 1 columns, 2 rows, 3 side by side,
                            // 4 top-bottom; the left eye first
    // Aspect of a pixel with which Matroska's DisplayWidth and DisplayHeight have the shape of one eye.
    int aspectWidth = 1, aspectHeight = 1;

    bool operator==(const StereoTag&) const = default;
};

StereoTag stereoTagOf(OutputMode mode, bool swapEyes = false);

// Returns whether a file of this kind has a tag for the mode; for one eye it needs none.
bool saysStereo(VideoKind kind, OutputMode mode, bool swapEyes = false);

}  // namespace stereonav
