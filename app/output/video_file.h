// A video written frame by frame next to its final place, and renamed when it is complete.
#pragma once

#include <filesystem>
#include <memory>

#include "app/output/stereo_tag.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

class VideoFile {
public:
    // The kind follows from the extension: .mp4 (H.264), .avi (Motion JPEG), .mkv (FFV1, lossless). Odd sizes
    // get a repeated last column or row; in .mkv only those of one pixel. stereo: the stereo tag, for kinds
    // that have one. Throws Error.
    VideoFile(const std::filesystem::path& file, double framesPerSecond, int width, int height,
              const StereoTag& stereo = {});
    ~VideoFile();  // removes an unfinished file

    void add(const Plane<PackedColor>& frame);
    void finish();

private:
    struct State;
    std::unique_ptr<State> mState;
};

// Returns the kind by extension; .mkv for all other files.
VideoKind videoKindOf(const std::filesystem::path& file);

// Returns the bytes per pixel that writing takes, beside the frame that is added.
double videoBytesAPixel(VideoKind kind);

// Throws Error that names `option` unless the extension is one of the above, frames of this size can be
// encoded here in this kind of file, and the place can be written.
void checkVideoFile(const std::string& option, const std::filesystem::path& file, int width, int height);

}  // namespace stereonav
