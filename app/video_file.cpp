#include "app/video_file.h"

#include <unistd.h>

#include "app/output_place.h"
#include "app/video_sink.h"
#include "engine/base/error.h"
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

fs::path besides(const fs::path& file) {
    fs::path temporary = file;
    temporary.replace_filename("." + file.stem().string() + "." + std::to_string(getpid()) + ".part" +
                               file.extension().string());
    return temporary;
}

}  // namespace

std::unique_ptr<VideoSink> openVideoSink(const fs::path& file, const char* codec, double framesPerSecond,
                                         int width, int height) {
    static const auto& functions = moduleFunctions<VideoFunctions>("video", "to write videos");
    return functions.open(file, codec, framesPerSecond, width, height);
}

struct VideoFile::State {
    fs::path file, temporary;
    std::unique_ptr<VideoSink> sink;
    int width = 0, height = 0;  // of a frame as given
    bool finished = false;
};

void checkVideoFile(const std::string& option, const fs::path& file) {
    if (!codecOf(file))
        throw Error(option, "", "\"" + file.string() + "\" is not a kind of video that can be written",
                    "use .mp4, .avi or .mkv (lossless)");
    checkOutputFile(option, file);
}

VideoFile::VideoFile(const fs::path& file, double framesPerSecond, int width, int height)
    : mState(std::make_unique<State>()) {
    const Error failed(file.string(), "", "can not be written as a video", "try another extension or folder");
    const char* codec = codecOf(file);
    if (!codec) throw failed;
    mState->file = file;
    mState->temporary = besides(file);
    mState->width = width;
    mState->height = height;
    std::error_code code;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), code);
    mState->sink = openVideoSink(mState->temporary, codec, framesPerSecond, width, height);
    if (mState->sink) return;
    fs::remove(mState->temporary, code);
    throw failed;
}

VideoFile::~VideoFile() {
    if (mState->finished) return;
    mState->sink.reset();
    std::error_code code;
    fs::remove(mState->temporary, code);
}

void VideoFile::add(const Plane<PackedColor>& frame) {
    if (frame.width() != mState->width || frame.height() != mState->height)
        throw Error(mState->file.string(), "", "expected frames of one size",
                    "keep the size while recording");
    mState->sink->add(frame);
}

void VideoFile::finish() {
    mState->sink->close();
    std::error_code code;
    fs::rename(mState->temporary, mState->file, code);
    if (code)
        throw Error(mState->file.string(), "", "can not be written", "check that the folder can be written");
    mState->finished = true;
}

}  // namespace stereonav
