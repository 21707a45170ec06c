// `stereonav play`: a flight into numbered pictures, a video, or one hash of all frames.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "app/command/paint_notes.h"
#include "app/command/quality.h"
#include "app/output/command_result.h"
#include "app/output/output_place.h"
#include "app/output/progress_bar.h"
#include "app/output/stereo_frame.h"
#include "app/output/video_file.h"
#include "app/scene/lazy_light.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/camera/timed_poses.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

constexpr int kMostFrames = 1'000'000;

double fpsOf(const PlayOptions& options) {
    return options.fps.value_or(25);
}

std::pair<int, int> frameSize(const PlayOptions& options) {
    return composedSize(options.mode, options.size.width, options.size.height);
}

// A video's codec holds frames as they are composed, in most modes with both eyes in them.
PixelBytes bytesOf(const PlayOptions& options) {
    if (options.video.empty()) return withRays(kRenderBytes, options.rays);
    const auto [width, height] = frameSize(options);
    const double eyes = 1.0 * width * height / (1.0 * options.size.width * options.size.height);
    const double codec = eyes * videoBytesAPixel(videoKindOf(options.video));
    return withRays({kVideoBytes.cast + codec, kVideoBytes.swept + codec, kVideoBytes.beside}, options.rays);
}

void checkOptions(const PlayOptions& options) {
    if (options.out.empty() && options.video.empty() && !options.hash)
        throw Error("play", "", "expected a place for the frames", "give --out DIR, --video FILE or --hash");
    if (!options.out.empty()) checkOutputFolder("--out", options.out);
    if (!options.video.empty()) {
        const auto [width, height] = frameSize(options);
        checkVideoFile("--video", options.video, width, height);
    }
    checkNoInput({"--video", options.video}, inputsOf(options.scene));
    checkSize(options.size, options.scene, bytesOf(options));
}

std::vector<TimedPose> posesOf(const PlayOptions& options, const RecordedPath& path) {
    if (options.frames > 0) return timedFrames(path, options.frames);
    const double fps = fpsOf(options);
    if (path.duration() * fps > kMostFrames)
        throw Error(
            "--fps", "",
            fmt::format("{} s at {} frames a second are over {} frames", path.duration(), fps, kMostFrames),
            "give --frames or fewer frames a second");
    return timedFramesAtRate(path, fps);
}

// Where composed frames go; what was not asked for stays unused.
class FrameSink {
public:
    FrameSink(const PlayOptions& options, const OutputMode mode) : mFolder(options.out), mMode(mode) {
        if (!options.out.empty()) makeOutputFolder(options.out);
        if (options.video.empty()) return;
        const auto [width, height] = frameSize(options);
        mVideo = std::make_unique<VideoFile>(options.video, fpsOf(options), width, height, stereoTagOf(mode));
    }

    void add(const StereoFrame& frame, int index) {
        if (mFolder.empty() && !mVideo) return;
        const Plane<PackedColor> picture = frame.compose(mMode);
        if (!mFolder.empty())
            writeColorImage(std::filesystem::path(mFolder) / fmt::format("frame_{:05d}.png", index), picture,
                            Flush::ToSystem);
        if (mVideo) mVideo->add(picture);
    }

    void finish() {
        if (mVideo) mVideo->finish();
    }

private:
    std::string mFolder;
    OutputMode mMode;
    std::unique_ptr<VideoFile> mVideo;
};

// "" where the video's file says how it shows two eyes.
std::string stereoNote(const PlayOptions& options) {
    if (options.video.empty() || saysStereo(videoKindOf(options.video), options.mode)) return "";
    const bool inMatroska = saysStereo(VideoKind::Mkv, options.mode);
    return fmt::format("{} does not say how its pictures show two eyes ({}): {}", options.video,
                       infoOf(options.mode).shortName,
                       inMatroska ? "tell the player, or write .mkv, which can" : "tell the player");
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void tellOfFlight(CommandResult& result, const PlayOptions& options, std::size_t frames, bool madeTogether,
                  const std::vector<double>& left_ms, const std::vector<double>& right_ms,
                  const std::vector<double>& both_ms) {
    result.add("frames", static_cast<std::int64_t>(frames));
    result.add("frames_per_second", fpsOf(options));
    result.add("size", FactIntegers{options.size.width, options.size.height});
    result.add("mode", std::string(infoOf(options.mode).shortName));
    if (!options.out.empty()) result.add("folder", options.out);
    if (!options.video.empty()) result.addFile("video", options.video);
    if (madeTogether) {
        result.say(fmt::format("{} frames, median both eyes {:.2f} ms\n", frames, medianOf(both_ms)));
        result.add("median_both_ms", medianOf(both_ms));
    } else {
        result.say(fmt::format("{} frames, median left {:.2f} ms, right {:.2f} ms\n", frames,
                               medianOf(left_ms), medianOf(right_ms)));
        result.add("median_left_ms", medianOf(left_ms));
        result.add("median_right_ms", medianOf(right_ms));
    }
    if (const std::string note = stereoNote(options); !note.empty()) {
        result.say(note + "\n");
        result.add("notes", FactWords{note});
    }
}

}  // namespace

int runPlay(const PlayOptions& options) {
    checkOptions(options);
    checkMethod(options.scene, options.method);
    // the path first: a bad one should not cost the reading of a large scene
    std::optional<RecordedPath> path;
    if (!options.path.empty()) path = readPath(options.path);
    CommandResult result("play", options.telling, {});
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> loaded =
        loadScene(options.scene, options.size, bar.progress(), bytesOf(options));
    const Scene& scene = *loaded;
    checkNotRead({{"--video", options.video}});
    const std::vector<TimedPose> poses = posesOf(options, flightOf(scene, path, options.path));
    FrameSink sink(options, options.mode);
    StereoFrame frame(scene, options.method);
    frame.refine(options.scene, options.rays, bar.progress());
    Hash hash;
    std::vector<double> left_ms, right_ms, both_ms;
    for (std::size_t k = 0; k < poses.size(); ++k) {
        bar.progress().report(static_cast<double>(k) / static_cast<double>(poses.size()),
                              fmt::format("frame {} of {}", k + 1, poses.size()));
        frame.render(poses[k].pose, poses[k].time);
        frame.paint();
        left_ms.push_back(frame.timings().left_ms);
        right_ms.push_back(frame.timings().right_ms);
        both_ms.push_back(frame.timings().both_ms);
        if (options.hash) frame.addTo(hash);
        sink.add(frame, static_cast<int>(k));
    }
    sink.finish();
    bar.clear();
    tellPaintNotes(scene, result);
    tellOfFlight(result, options, poses.size(), frame.timings().left_ms == 0, left_ms, right_ms, both_ms);
    result.add("scene", scene.name);
    if (options.hash) {
        const std::string text = fmt::format("{:016x}", hash.value());
        result.answer("hash " + text + "\n");
        result.add("hash", text);
    }
    result.finish();
    return 0;
}

}  // namespace stereonav
