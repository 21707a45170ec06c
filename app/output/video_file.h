// A video written frame by frame beside its place, and renamed into it when complete.
#pragma once

#include <filesystem>
#include <memory>

#include "app/output/stereo_tag.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

class VideoFile {
public:
    // By extension: .mp4 (H.264), .avi (Motion JPEG), .mkv (FFV1, lossless). Odd sizes get a repeated last
    // column or row; of .mkv those of one pixel alone. stereo: what the file says of its eyes, where its
    // kind can. Throws Error.
    VideoFile(const std::filesystem::path& file, double framesPerSecond, int width, int height,
              const StereoTag& stereo = {});
    ~VideoFile();  // what was not finished is removed

    void add(const Plane<PackedColor>& frame);
    void finish();

private:
    struct State;
    std::unique_ptr<State> mState;
};

// By extension; .mkv for what has none of the above.
VideoKind videoKindOf(const std::filesystem::path& file);

// Bytes that writing it takes for each pixel of its frames, beside the frame that is added.
double videoBytesAPixel(VideoKind kind);

// Throws Error naming `option` unless the extension is one of the above, frames of this size can be coded,
// here and in this kind of file, and the place can be written.
void checkVideoFile(const std::string& option, const std::filesystem::path& file, int width, int height);

}  // namespace stereonav
