// `stereonav play`: turns a flight into numbered pictures, a video, or one hash of all frames.
#include "app/command/play_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "app/command/paint_notes.h"
#include "app/command/play_frames.h"
#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/output/stereo_frame.h"
#include "app/output/video_file.h"
#include "app/scene/quality.h"
#include "app/scene/terrain/terrain_facts.h"
#include "app/scene/volume/lazy_light.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/camera/timed_poses.h"
#include "engine/peers/piece_dealer.h"

namespace stereonav {
namespace {

constexpr int kMostFrames = 1'000'000;

std::pair<int, int> frameSize(const PlayOptions& options) {
    return composedSize(options.mode, options.size.width, options.size.height);
}

// Returns how many frames may be made ahead of the next one to write: two per process, so that a slow frame
// delays nobody.
std::size_t framesAhead(const Peers& peers) {
    return 2 * static_cast<std::size_t>(peers.count());
}

// Returns the bytes per pixel. A video's codec holds composed frames, which in most modes contain both eyes.
// The first of several processes holds frames that wait for their turn.
PixelBytes bytesOf(const PlayOptions& options) {
    const Peers& peers = peersOfThisRun();
    const auto [width, height] = frameSize(options);
    const double eyes = 1.0 * width * height / (1.0 * options.size.width * options.size.height);
    const double waiting =
        peers.alone() || !peers.first() ? 0 : framesAhead(peers) * packedBytesAPixel(options, eyes);
    const bool coded = !options.video.empty() && peers.first();
    const double codec = coded ? eyes * videoBytesAPixel(videoKindOf(options.video)) : 0;
    const PixelBytes& each = coded ? kVideoBytes : kRenderBytes;
    return withRays({each.cast + codec + waiting, each.swept + codec + waiting, each.beside}, options.rays);
}

void checkOptions(const PlayOptions& options) {
    if (options.out.empty() && options.video.empty() && !options.hash)
        throw Error("play", "", "expected a place for the frames", "give --out DIR, --video FILE or --hash");
    if (options.scene.quality.target_ms && !peersOfThisRun().alone())
        throw Error("--target-ms", "", "does not go with several processes, whose measurements differ",
                    "use --quality");
    // Other processes write nothing, and may run where the output places do not exist.
    const bool writes = peersOfThisRun().first();
    if (writes && !options.out.empty()) checkOutputFolder("--out", options.out);
    if (writes && !options.video.empty()) {
        const auto [width, height] = frameSize(options);
        checkVideoFile("--video", options.video, width, height);
    }
    checkNoInput({"--video", options.video}, inputsOf(options.scene));
    checkSize(options.size, options.scene, bytesOf(options));
}

std::vector<TimedPose> posesOf(const PlayOptions& options, const RecordedPath& path) {
    if (options.frames) return timedFrames(path, *options.frames);
    const double fps = options.fps;
    if (path.duration() * fps > kMostFrames)
        throw Error(
            "--fps", "",
            fmt::format("{} s at {} frames a second are over {} frames", path.duration(), fps, kMostFrames),
            "give --frames or fewer frames a second");
    return timedFramesAtRate(path, fps);
}

// Returns the first and last frame to make.
std::pair<std::size_t, std::size_t> partOf(const PlayOptions& options, std::size_t frames) {
    if (!options.part) return {0, frames - 1};
    const auto [first, last] = *options.part;
    if (static_cast<std::size_t>(last) >= frames)
        throw Error("--frames", "",
                    fmt::format("the flight has frames 0 to {} at {:g} a second, got {}..{}", frames - 1,
                                options.fps, first, last),
                    "end earlier");
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

// Returns a note for videos without a stereo tag; "" where the file has one.
std::string stereoNote(const PlayOptions& options) {
    if (options.video.empty() || saysStereo(videoKindOf(options.video), options.mode)) return "";
    const bool inMatroska = saysStereo(VideoKind::Mkv, options.mode);
    return fmt::format(
        "{} can not hold how its pictures show two eyes ({}): {}", options.video,
        infoOf(options.mode).shortName,
        inMatroska ? "set it in the player, or write .mkv, which can" : "set it in the player");
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct FlownPart {
    std::size_t first = 0, last = 0;  // numbers of frames in the whole flight
    std::size_t count() const { return last - first + 1; }
};

void tellOfFlight(CommandResult& result, const PlayOptions& options, const FlownPart& flight,
                  const FrameSink& sink) {
    const std::size_t frames = flight.count();
    result.add("frames", static_cast<std::int64_t>(frames));
    if (options.part) result.add("first_frame", static_cast<std::int64_t>(flight.first));
    if (peersOfThisRun().count() > 1)
        result.add("processes", static_cast<std::int64_t>(peersOfThisRun().count()));
    result.add("frames_per_second", options.fps);
    result.add("size", FactIntegers{options.size.width, options.size.height});
    result.add("mode", std::string(infoOf(options.mode).shortName));
    if (!options.out.empty()) result.add("folder", options.out);
    if (!options.video.empty()) result.addFile("video", options.video);
    if (sink.left_ms.back() == 0) {  // both eyes were made together
        result.say(fmt::format("{} frames, median both eyes {:.2f} ms\n", frames, medianOf(sink.both_ms)));
        result.add("median_both_ms", medianOf(sink.both_ms));
    } else {
        result.say(fmt::format("{} frames, median left {:.2f} ms, right {:.2f} ms\n", frames,
                               medianOf(sink.left_ms), medianOf(sink.right_ms)));
        result.add("median_left_ms", medianOf(sink.left_ms));
        result.add("median_right_ms", medianOf(sink.right_ms));
    }
    if (const std::string note = stereoNote(options); !note.empty()) {
        result.say(note + "\n");
        result.add("notes", FactWords{note});
    }
}

void flyAlone(const FlownPart& flight, FlightFrames& frames, FrameSink& sink, Progress& progress) {
    for (std::size_t k = flight.first; k <= flight.last; ++k) {
        progress.report(static_cast<double>(k - flight.first) / static_cast<double>(flight.count()),
                        fmt::format("frame {} of {}", k - flight.first + 1, flight.count()));
        sink.add(frames.make(k), k);
    }
    progress.report(1, "flown");
}

// Makes frames in all processes; this one writes them in their order.
void flyWithOthers(const PlayOptions& options, const FlownPart& flight, FlightFrames& frames, FrameSink& sink,
                   Progress& progress) {
    PieceWork work;
    work.count = flight.count();
    work.inOrder = true;
    work.ahead = framesAhead(peersOfThisRun());
    work.make = [&](std::size_t n, std::span<const std::byte>) {
        return packedFrame(frames.make(flight.first + n), options);
    };
    work.take = [&](std::size_t n, std::span<const std::byte> made) {
        progress.report(static_cast<double>(n) / static_cast<double>(flight.count()),
                        fmt::format("frame {} of {}", n + 1, flight.count()));
        sink.add(made, flight.first + n);
    };
    PieceDealer(peersOfThisRun()).deal(work);
    progress.report(1, "flown");
}

std::vector<Option> playOptions() {
    return {
        {.key = "out",
         .value = fileValue(),
         .help = "folder for frame_00000.png and so on",
         .take = into<&PlayOptions::out>},
        {.key = "video",
         .value = fileValue(),
         .help = "a video: .mp4, .avi or .mkv (lossless)",
         .take = into<&PlayOptions::video>},
        {.key = "frames",
         .value = wholeOrPartValue(within(1, 1e6, "frames")),
         .help = "number of frames, evenly over the path; or a part of the whole path's frames at --fps, "
                 "such as 0..249 for the first 250, which keep their numbers",
         .advice = "leave it out for the whole path at --fps",
         .fallback = "the whole path at --fps",
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 const auto at = [&](std::size_t n) { return static_cast<int>(value.numbers[n]); };
                 auto& options = to.of<PlayOptions>();
                 if (value.numbers.size() == 1)
                     options.frames = at(0);
                 else
                     options.part = {at(0), at(1)};
             }},
        {.key = "fps",
         .value = numberValue(within(0.001, 1000, "frames a second")),
         .help = "frame rate of the video or pictures",
         .advice = "25 is common",
         .fallback = "25",
         .rules = {{[](const Asked& asked) {
                        return asked.has("frames") && !asked.has("video") &&
                               asked.given.text("frames").find("..") == std::string::npos;
                    },
                    "has no effect beside --frames, which says how many pictures there are",
                    "leave one of them out, or give --video"}},
         .take = into<&PlayOptions::fps>},
        {.key = "hash",
         .value = flagValue(),
         .help = "print one content hash of both eyes of all frames",
         .take = into<&PlayOptions::hash>},
    };
}

}  // namespace

int runPlay(const PlayOptions& options) {
    Peers& peers = peersOfThisRun();
    checkOptions(options);
    checkMethod(options.scene, options.method);
    // The path is read first: a bad one should not cost the reading of a large scene.
    std::optional<RecordedPath> path;
    if (!options.path.empty()) path = readPath(options.path);
    CommandResult result("play", options.telling, {});
    ProgressBar bar(!options.telling.quiet && peers.first());
    const std::unique_ptr<Scene> loaded =
        loadScene(options.scene, options.size, bar.progress(), bytesOf(options));
    const Scene& scene = *loaded;
    if (peers.first()) checkNotRead({{"--video", options.video}});
    const std::vector<TimedPose> poses = posesOf(options, flightOf(scene, path, options.path));
    const auto [first, last] = partOf(options, poses.size());
    const FlownPart flight{first, last};
    StereoFrame frame(scene, options.method);
    frame.refine(options.scene, options.rays, bar.progress());
    FlightFrames frames(frame, poses);
    if (!peers.first()) {
        peers.serve([&](std::size_t n, std::span<const std::byte>) {
            return packedFrame(frames.make(flight.first + n), options);
        });
        return 0;
    }
    FrameSink sink(options);
    if (peers.alone())
        flyAlone(flight, frames, sink, bar.progress());
    else
        flyWithOthers(options, flight, frames, sink, bar.progress());
    sink.finish();
    bar.clear();
    tellPaintNotes(scene, result);
    tellWarning(scene, options.telling, result);
    tellOfFlight(result, options, flight, sink);
    result.addScene(scene.name);
    if (std::optional<Fact> earth = factOfCurvature(scene)) result.add(earth->key, std::move(earth->value));
    if (options.hash) {
        const std::string text = fmt::format("{:016x}", sink.hash());
        result.answer("hash " + text + "\n");
        result.add("hash", text);
    }
    result.finish();
    return 0;
}

Command playCommand() {
    return {.name = "play",
            .help = "play a flight into pictures, a video, or a hash",
            .scenes = scene_type::kAll,
            .command = command::kPlay,
            .traits = command::kShowing | command::kTelling,
            .chapter = Chapter::Pictures,
            .options = playOptions,
            .start = startOf<PlayOptions, runPlay>};
}

}  // namespace stereonav
