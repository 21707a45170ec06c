#include "app/output/video_file.h"

#include <string>

#include "app/output/output_place.h"
#include "app/output/video_check.h"
#include "app/output/video_sink.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/module.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

// Four letters; null where the extension is none of a video that can be written.
const char* codecOf(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".mp4") return "mp4v";
    if (extension == ".avi") return "MJPG";
    if (extension == ".mkv") return "FFV1";
    return nullptr;
}

}  // namespace

std::unique_ptr<VideoSink> openVideoSink(const fs::path& file, const char* codec, double framesPerSecond,
                                         int width, int height) {
    static const auto& functions = moduleFunctions<VideoFunctions>("video", "to write videos");
    return functions.open(file, codec, framesPerSecond, width, height);
}

bool isLosslessVideo(const fs::path& file) {
    return file.extension() == ".mkv";
}

struct VideoFile::State {
    State(const fs::path& file, int wide, int high) : place(file), pending(file), width(wide), height(high) {}
    fs::path place;
    PendingFile pending;
    std::unique_ptr<VideoSink> sink;  // before `pending` goes
    int width, height;                // of a frame as given
    long long frames = 0;
};

void checkVideoFile(const std::string& option, const fs::path& file) {
    if (!codecOf(file))
        throw Error(option, "", "\"" + file.string() + "\" is not a kind of video that can be written",
                    "use .mp4, .avi or .mkv (lossless)");
    std::error_code code;
    if (fs::exists(file, code) && !fs::is_regular_file(file, code))
        throw Error(option, "", "\"" + file.string() + "\" is no file, and a video is not written in one go",
                    "name a file");
    checkOutputFile(option, file);
}

VideoFile::VideoFile(const fs::path& file, double framesPerSecond, int width, int height) {
    const Error failed(file.string(), "", "can not be written as a video", "try another extension or folder");
    const char* codec = codecOf(file);
    if (!codec) throw failed;
    mState = std::make_unique<State>(file, width, height);
    mState->sink = openVideoSink(mState->pending.temporary(), codec, framesPerSecond, width, height);
    if (!mState->sink) throw failed;
}

VideoFile::~VideoFile() = default;

void VideoFile::add(const Plane<PackedColor>& frame) {
    if (frame.width() != mState->width || frame.height() != mState->height)
        throw Error(mState->place.string(), "", "expected frames of one size",
                    "keep the size while recording");
    mState->sink->add(frame);
    ++mState->frames;
}

void VideoFile::finish() {
    if (!mState->sink->close() || !isEndedVideo(mState->pending.temporary(), mState->frames))
        throw Error(mState->place.string(), "", "can not be written: not all of it arrived",
                    "check that the disk has room");
    mState->pending.finish();
}

}  // namespace stereonav
