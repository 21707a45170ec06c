// Options: size, method, pose and output of pictures.
#include <fmt/format.h>

#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/picture_options.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "engine/base/file.h"
#include "engine/frame/refined_frames.h"
#include "engine/image/stereo_picture_file.h"

namespace stereonav {
namespace {

using namespace command;
using namespace scene_type;

void takeSize(OptionTargets& to, const OptionValue& value) {
    *to.size = {static_cast<int>(value.numbers[0]), static_cast<int>(value.numbers[1])};
}
void takeMethod(OptionTargets& to, const OptionValue& value) {
    *to.method = value.text;
}
void takeMode(OptionTargets& to, const OptionValue& value) {
    *to.mode = outputModeFromName(value.text).value_or(OutputMode::SideBySide);
}
void takePath(OptionTargets& to, const OptionValue& value) {
    *to.path = value.text;
}
// Stores --frames: one number is a count, two are the first and last frame.
void takeFrames(OptionTargets& to, const OptionValue& value) {
    const auto at = [&](std::size_t n) { return static_cast<int>(value.numbers[n]); };
    if (value.numbers.size() == 1)
        to.of<PlayOptions>().frames = at(0);
    else
        to.of<PlayOptions>().part = {at(0), at(1)};
}

std::optional<ValueProblem> problemOfMode(const std::string& text) {
    if (outputModeFromName(text)) return std::nullopt;
    return ValueProblem{"there is no output mode \"" + text + "\"", "the modes are " + outputModeNames(true)};
}

std::optional<ValueProblem> problemOfFileMode(const std::string& text) {
    const std::optional<OutputMode> mode = outputModeFromName(text);
    const std::string modes = "the modes are " + outputModeNames(false);
    if (!mode) return ValueProblem{"there is no output mode \"" + text + "\"", modes};
    if (fitsInPicture(*mode)) return std::nullopt;
    return ValueProblem{text + " shows one eye after the other, which view alone can", modes};
}

// Pictures that hold both eyes in an arrangement of their own (.jps, .mpo).
bool rendersJpsOtherwise(const Asked& asked) {
    return asked.runs(kRender) && isJps(asked.given.text("out")) &&
           outputModeFromName(asked.given.text("mode")) != OutputMode::CrossEyed;
}
bool rendersMpo(const Asked& asked) {
    return asked.runs(kRender) && isMpo(asked.given.text("out"));
}

}  // namespace

std::vector<Option> viewOptions() {
    return {
        {.key = "size",
         .value = sizeValue(),
         .help = "of one eye",
         .advice = "try 1280x720",
         .fallback = "1280x720",
         .commands = kInfo | kRender | kPlay | kView,
         .take = takeSize},
        {.key = "size",
         .value = sizeValue(),
         .help = "of one eye",
         .advice = "try 1280x720",
         .fallback = "500x400",
         .commands = kCompare,
         .take = takeSize},
        {.key = "pose",
         .value = numbersValue(poseNumbers()),
         .help = "where the head is",
         .fallback = "the start pose",
         .commands = kRender,
         .inFile = false,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<RenderOptions>().pose = poseOf(value); }},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path)",
         .fallback = "the scene's own",
         .commands = kPlay | kCompare,
         .inFile = false,
         .take = takePath},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path) for Z to play, and for --bench",
         .commands = kView,
         .inFile = false,
         .take = takePath},
        {.key = "method",
         .value = textValue(),
         .help = "how the right eye is made, or both eyes of a medium",
         .fallback = "auto, the best",
         .commands = kRender | kPlay,
         .rules = {{[](const Asked& asked) {
                        return asked.is("light", "traced") && asked.shows(kSurfaces) &&
                               !asked.is("method", "auto") && !asked.is("method", "full");
                    },
                    "{method} does not go with --light traced", "leave it out: each eye is traced in full"}},
         .take = takeMethod},
        {.key = "method",
         .value = textValue(),
         .help = "how the right eye is made, or both eyes of a medium",
         .fallback = "auto, what measures best here",
         .commands = kView,
         .panel = OptionPanel::Quality,
         .take = takeMethod},
        {.key = "mode",
         .value = textValue().checked(problemOfMode),
         .help =
             "how two eyes are shown: ml, mr, sbsl, sbsr, tbl, irl, arcd, ...; al, ar: by turns, for shutter "
             "glasses that follow a monitor of 100 Hz or more; quad: by the driver",
         .fallback = "sbsl",
         .commands = kView,
         .panel = OptionPanel::View,
         .take = takeMode},
        {.key = "full-screen",
         .value = textValue().checked([](const std::string& text) {
             return text.empty() ? std::optional(ValueProblem{"expected a monitor, got \"\"", "try auto"})
                                 : std::nullopt;
         }),
         .help = "over a whole monitor: auto, the one that the window is on; its number, or part of its name",
         .advice = "try auto",
         .commands = kView,
         .take = into<&ViewOptions::fullScreen>},
        {.key = "screen-width",
         .value = numberValue(above(0, 1e5, "mm")),
         .help = "of the whole monitor or projection, for parallax in millimetres",
         .advice = "leave it out for what the monitor tells",
         .fallback = "what the monitor tells, or 500",
         .commands = kView,
         .panel = OptionPanel::View,
         .take = into<&ViewOptions::screenWidth_mm>},
        {.key = "viewing-distance",
         .value = numberValue(above(0, 1e6, "mm")),
         .help = "from the eyes to the screen, for parallax in degrees",
         .advice = "600 is usual at a desk",
         .fallback = "600",
         .commands = kView,
         .panel = OptionPanel::View,
         .take = into<&ViewOptions::viewingDistance_mm>},
        {.key = "mode",
         .value = textValue().checked(problemOfFileMode),
         .help = "how two eyes become one picture: ml, mr, sbsl, sbsr, tbl, irl, arcd, ...",
         .fallback = "sbsl",
         .commands = kRender | kPlay,
         .rules = {{[](const Asked& asked) {
                        return asked.has("hash") && !asked.has("out") && !asked.has("video");
                    },
                    "has no effect on --hash, which is of both eyes", kLeaveItOut},
                   {rendersJpsOtherwise,
                    "{mode} does not go with --out {out}: a .jps has the right eye on the left",
                    "leave it out, say sbsr, or write a .jpg"},
                   {rendersMpo,
                    "{mode} does not go with --out {out}: a .mpo has each eye as a picture of its own",
                    "leave it out, or write a .jpg"}},
         .panel = OptionPanel::View,
         .take = takeMode},
        {.key = "sweep",
         .value = wordValue({"auto", "cpu", "gpu"}),
         .help = "where a medium is swept; gpu: OpenGL 4.5",
         .advice = "auto takes what is faster here",
         .fallback = "auto, what is faster here",
         .commands = kView,
         .rules = {{[](const Asked& asked) { return !asked.is("sweep", "auto") && !asked.shows(kMedia); },
                    "expected with a medium", "leave it out, or show one with --medium"}},
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::sweep>},
        {.key = "shots",
         .value = fileValue(),
         .help = "folder for saved pictures and recorded flights",
         .fallback = "the present one",
         .commands = kView,
         .inFile = false,
         .take = into<&ViewOptions::shots>},
        {.key = "late-warp",
         .value = wordValue({"on", "off"}),
         .help =
             "while something moves: the newest picture, warped to where the eyes are now, at each refresh",
         .fallback = "on",
         .commands = kView,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewOptions>().lateWarp = value.text == "on"; }},
        {.key = "refine",
         .value = wordValue({"on", "off"}),
         .help = fmt::format(
             "while nothing moves: both eyes cast in full again and again, {} rays a pixel at most",
             kMostRaysAtRest),
         .fallback = "on",
         .commands = kView,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewOptions>().refine = value.text == "on"; }},
        {.key = "target-ms",
         .value = numberValue(within(1e-3, 1e6, "ms")),
         .help =
             "that a frame may take while something moves: it is made smaller, and enlarged, to keep that",
         .advice = "33 is 30 frames a second",
         .fallback = "twice the monitor's refresh, at most 40; four times that of a medium",
         .commands = kView,
         .rules = {{[](const Asked& asked) { return asked.is("late-warp", "off"); },
                    "has no effect beside --late-warp off, whose frames are whole", kLeaveItOut}},
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::target_ms>},
        {.key = "bench",
         .value = flagValue(),
         .help = "flies --path, or 20 s of the scene's own flight at most, rests for 10 s, tells how evenly "
                 "pictures came, how old and how right they were, and closes",
         .commands = kView,
         .inFile = false,
         .take = into<&ViewOptions::bench>},
    };
}

std::vector<Option> pictureOptions() {
    return {
        {.key = "out",
         .value = fileValue(),
         .help = "the picture's file, .jps and .mpo for 3D viewers; -: PNG to standard output",
         .commands = kRender,
         .required = true,
         .take = into<&RenderOptions::out>},
        {.key = "out",
         .value = fileValue(),
         .help = "folder for frame_00000.png and so on",
         .commands = kPlay,
         .take = into<&PlayOptions::out>},
        {.key = "video",
         .value = fileValue(),
         .help = "a video: .mp4, .avi or .mkv (lossless)",
         .commands = kPlay,
         .take = into<&PlayOptions::video>},
        {.key = "frames",
         .value = wholeOrPartValue(within(1, 1e6, "frames")),
         .help =
             "this many, evenly over the path; or some of the whole path's at --fps, 0..249 being the first "
             "250, with the numbers that they have there",
         .advice = "leave it out for the whole path at --fps",
         .fallback = "the whole path at --fps",
         .commands = kPlay,
         .take = takeFrames},
        {.key = "fps",
         .value = numberValue(within(0.001, 1000, "frames a second")),
         .help = "of a video, or of pictures",
         .advice = "25 is common",
         .fallback = "25",
         .commands = kPlay,
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
         .commands = kPlay,
         .take = into<&PlayOptions::hash>},
        {.key = "series-pictures",
         .value = fileValue(),
         .help = "of a DICOM folder: list its series alone, and write a picture of each into this folder",
         .commands = kInfo,
         .scenes = kStudies,
         .elsewhere = {nullptr, "expected with a folder of DICOM slices", "name one, or leave it out"},
         .take = into<&InfoOptions::series>},
    };
}

std::vector<Option> tellingOptions() {
    return {
        {.key = "json",
         .value = flagValue(),
         .help = "tells what was done, or found, as one JSON document on standard output",
         .commands = kTelling,
         .take = [](OptionTargets& to, const OptionValue&) { to.telling->json = true; }},
        {.key = "json",
         .value = fileValue(),
         .help = "tells what was done as one JSON document when the window is closed, into a file; -, or "
                 "nothing: "
                 "on standard output",
         .commands = kView,
         .inFile = false,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<ViewOptions>().json = value.text;
                 to.telling->json = isStandardOutput(value.text);
             }},
        {.key = "quiet",
         .value = flagValue(),
         .help = "neither progress nor notes: only what was asked for, and errors",
         .commands = command::kAll,
         .take = [](OptionTargets& to, const OptionValue&) { to.telling->quiet = true; }},
    };
}

}  // namespace stereonav
