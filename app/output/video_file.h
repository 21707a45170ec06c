// A video written frame by frame beside its place, and renamed into it when complete.
#pragma once

#include <filesystem>
#include <memory>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

class VideoFile {
public:
    // By extension: .mp4 (MPEG-4), .avi (Motion JPEG), .mkv (FFV1, lossless). Odd sizes get a repeated
    // last column or row. Throws Error.
    VideoFile(const std::filesystem::path& file, double framesPerSecond, int width, int height);
    ~VideoFile();  // what was not finished is removed

    void add(const Plane<PackedColor>& frame);
    void finish();

private:
    struct State;
    std::unique_ptr<State> mState;
};

// Whether its frames are coded without loss, which takes more memory.
bool isLosslessVideo(const std::filesystem::path& file);

// Throws Error naming `option` unless the extension is one of the above and the place can be written.
void checkVideoFile(const std::string& option, const std::filesystem::path& file);

}  // namespace stereonav
