#include "app/output/video_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/options/output_place.h"
#include "app/output/video_check.h"
#include "app/output/video_sink.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/module.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

// Sizes that the codec accepts, and the bytes it holds per pixel of a frame, measured with 2560x720 and
// 7680x2160 and rounded up.
struct KindFacts {
    const char* extension;
    VideoKind kind;
    int longest;
    double bytesAPixel;
};
constexpr KindFacts kKinds[] = {{".mp4", VideoKind::Mp4, 16384, 72},
                                {".avi", VideoKind::Avi, 65500, 8},
                                {".mkv", VideoKind::Mkv, 65535, 160}};
constexpr double kMostPixels = 2.5e8;  // FFmpeg's own limit is 2.68e8

// Returns null where no video can be written with this extension.
const KindFacts* factsOfVideo(const fs::path& file) {
    const std::string extension = file.extension().string();
    for (const KindFacts& facts : kKinds)
        if (extension == facts.extension) return &facts;
    return nullptr;
}

const VideoFunctions& videoModule() {
    static const auto& functions = moduleFunctions<VideoFunctions>("video", "to write videos");
    return functions;
}

void checkFrameSize(const std::string& name, const KindFacts& facts, int width, int height) {
    if (std::max(width, height) <= facts.longest && 1.0 * width * height <= kMostPixels) return;
    throw Error(name, "",
                fmt::format("frames of {}x{} do not go into {}, which takes {} a side and 250 million pixels",
                            width, height, facts.extension, facts.longest),
                "make them smaller, or write pictures with --out");
}

}  // namespace

void checkVideoCodec(const std::string& name, VideoKind kind) {
    videoModule().check(name, kind);
}

std::unique_ptr<VideoSink> openVideoSink(const VideoOrder& order) {
    return videoModule().open(order);
}

VideoKind videoKindOf(const fs::path& file) {
    const KindFacts* facts = factsOfVideo(file);
    return facts ? facts->kind : VideoKind::Mkv;
}

double videoBytesAPixel(VideoKind kind) {
    for (const KindFacts& facts : kKinds)
        if (facts.kind == kind) return facts.bytesAPixel;
    return 0;
}

struct VideoFile::State {
    State(const fs::path& file, int wide, int high) : place(file), pending(file), width(wide), height(high) {}
    fs::path place;
    PendingFile pending;
    std::unique_ptr<VideoSink> sink;  // destroyed before `pending`
    int width, height;                // size of a frame as given
    long long frames = 0;
};

void checkVideoFile(const std::string& option, const fs::path& file, int width, int height) {
    const KindFacts* facts = factsOfVideo(file);
    if (!facts)
        throw Error(option, "", "\"" + file.string() + "\" is not a kind of video that can be written",
                    "use .mp4, .avi or .mkv (lossless)");
    std::error_code code;
    if (fs::exists(file, code) && !fs::is_regular_file(file, code))
        throw Error(option, "", "\"" + file.string() + "\" is no file, and a video is not written in one go",
                    "name a file");
    checkFrameSize(option, *facts, width, height);
    checkOutputFile(option, file);
    checkVideoCodec(option, facts->kind);
}

VideoFile::VideoFile(const fs::path& file, double framesPerSecond, int width, int height,
                     const StereoTag& stereo) {
    const KindFacts* facts = factsOfVideo(file);
    if (!facts || width < 1 || height < 1 || !(framesPerSecond >= 0.001 && framesPerSecond <= 1000))
        throw Error(file.string(), "", "can not be written as a video", "try another extension or folder");
    checkFrameSize(file.string(), *facts, width, height);
    mState = std::make_unique<State>(file, width, height);
    mState->sink = openVideoSink(
        {mState->pending.temporary(), file.string(), facts->kind, framesPerSecond, width, height, stereo});
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
