// `stereonav view`, in builds with and without the window.
#include "app/view/window/view_command.h"

#include <fmt/format.h>

#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/options/usual_words.h"
#include "engine/base/file.h"
#include "engine/frame/refined_frames.h"

namespace stereonav {
namespace {

std::optional<ValueProblem> problemOfMode(const std::string& text) {
    if (outputModeFromName(text)) return std::nullopt;
    return ValueProblem{"there is no output mode \"" + text + "\"", "the modes are " + outputModeNames(true)};
}

// Returns the options of what is shown, and on which screen.
std::vector<Option> shownOptions() {
    return {
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path) for Z to play, and for --bench",
         .behind = "path",
         .inFile = false,
         .take = into<&ViewOptions::path>},
        {.key = "method",
         .value = textValue(),
         .help = "how the right eye is made, or both eyes of a medium",
         .fallback = "auto, what measures best here",
         .behind = "method",
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::method>},
        {.key = "mode",
         .value = textValue().checked(problemOfMode),
         .help =
             "how two eyes are shown: ml, mr, sbsl, sbsr, tbl, irl, arcd, ...; al, ar: by turns, for shutter "
             "glasses that follow a monitor of 100 Hz or more; quad: by the driver",
         .fallback = "sbsl",
         .panel = OptionPanel::View,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<ViewOptions>().mode = outputModeFromName(value.text).value_or(OutputMode::SideBySide);
             }},
        {.key = "full-screen",
         .value = textValue().checked([](const std::string& text) {
             return text.empty() ? std::optional(ValueProblem{"expected a monitor, got \"\"", "try auto"})
                                 : std::nullopt;
         }),
         .help = "over a whole monitor: auto, the one that the window is on; its number, or part of its name",
         .advice = "try auto",
         .take = into<&ViewOptions::fullScreen>},
        {.key = "screen-width",
         .value = numberValue(above(0, 1e5, "mm")),
         .help = "of the whole monitor or projection, for parallax in millimetres",
         .advice = "leave it out for what the monitor tells",
         .fallback = "what the monitor tells, or 500",
         .panel = OptionPanel::View,
         .take = into<&ViewOptions::screenWidth_mm>},
        {.key = "viewing-distance",
         .value = numberValue(above(0, 1e6, "mm")),
         .help = "from the eyes to the screen, for parallax in degrees",
         .advice = "600 is usual at a desk",
         .fallback = "600",
         .panel = OptionPanel::View,
         .take = into<&ViewOptions::viewingDistance_mm>},
    };
}

// Returns the options of frames, and of a run of the window.
std::vector<Option> runOptions() {
    return {
        {.key = "sweep",
         .value = wordValue({"auto", "cpu", "gpu"}),
         .help = "where a medium is swept; gpu: OpenGL 4.5",
         .advice = "auto takes what is faster here",
         .fallback = "auto, what is faster here",
         .behind = "mode",
         .rules = {{[](const Asked& asked) {
                        return !asked.is("sweep", "auto") && !asked.shows(scene_type::kMedia);
                    },
                    "expected with a medium", "leave it out, or show one with --medium"}},
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::sweep>},
        {.key = "shots",
         .value = fileValue(),
         .help = "folder for saved pictures and recorded flights",
         .fallback = "the present one",
         .inFile = false,
         .take = into<&ViewOptions::shots>},
        {.key = "late-warp",
         .value = wordValue({"on", "off"}),
         .help =
             "while something moves: the newest picture, warped to where the eyes are now, at each refresh",
         .fallback = "on",
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewOptions>().lateWarp = value.text == "on"; }},
        {.key = "refine",
         .value = wordValue({"on", "off"}),
         .help = fmt::format(
             "while nothing moves: both eyes cast in full again and again, {} rays a pixel at most",
             kMostRaysAtRest),
         .fallback = "on",
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewOptions>().refine = value.text == "on"; }},
        {.key = "target-ms",
         .value = numberValue(within(1e-3, 1e6, "ms")),
         .help =
             "that a frame may take while something moves: it is made smaller, and enlarged, to keep that",
         .advice = "33 is 30 frames a second",
         .fallback = "twice the monitor's refresh, at most 40; four times that of a medium",
         .rules = {{[](const Asked& asked) { return asked.is("late-warp", "off"); },
                    "has no effect beside --late-warp off, whose frames are whole", kLeaveItOut}},
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::target_ms>},
        {.key = "bench",
         .value = flagValue(),
         .help = "flies --path, or 20 s of the scene's own flight at most, rests for 10 s, tells how evenly "
                 "pictures came, how old and how right they were, and closes",
         .inFile = false,
         .take = into<&ViewOptions::bench>},
        {.key = "json",
         .value = fileValue(),
         .help = "tells what was done as one JSON document when the window is closed, into a file; -, or "
                 "nothing: "
                 "on standard output",
         .behind = "json",
         .inFile = false,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<ViewOptions>().json = value.text;
                 to.telling->json = isStandardOutput(value.text);
             }},
    };
}

std::vector<Option> viewOptions() {
    std::vector<Option> all = shownOptions();
    for (Option& option : runOptions()) all.push_back(std::move(option));
    return all;
}

}  // namespace

Command viewCommand() {
    return {.name = "view",
            .help = "fly through the scene in a window",
            .scenes = scene_type::kAll,
            .command = command::kView,
            .traits = command::kShowing,
            .options = viewOptions,
            .start = startOf<ViewOptions, runView>};
}

}  // namespace stereonav
