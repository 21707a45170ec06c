// The command `stereonav view`, in builds with and without the window.
#include "app/view/window/view_command.h"

#include <fmt/format.h>

#include "app/options/command.h"
#include "app/options/offered_words.h"
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

// Returns the options for what is shown, and on which screen.
std::vector<Option> shownOptions() {
    return {
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path), which Z plays and --bench flies",
         .behind = "path",
         .inFile = false,
         .take = into<&ViewOptions::path>},
        {.key = "method",
         .value = textValue().offering(methodWords()),
         .help = "how the right eye is made, or both eyes of a medium",
         .also = "warp reprojection right eye",
         .fallback = "auto, the one that measures best on this machine",
         .behind = "method",
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::method>},
        {.key = "mode",
         .value = textValue().checked(problemOfMode).offering(modeWords(true)),
         .help = "how two eyes are shown: ml, mr, sbsl, sbsr, tbl, irl, arcd, ...; al, ar: alternating, for "
                 "shutter glasses and a monitor of 100 Hz or more; quad: the graphics driver's stereo",
         .also = "anaglyph stereo 3d glasses interlaced side-by-side sbs layout output display",
         .fallback = "as it was left, at first one eye",
         .panel = OptionPanel::View,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<ViewOptions>().mode = outputModeFromName(value.text);
             }},
        {.key = "full-screen",
         .value = textValue()
                      .checked([](const std::string& text) {
                          return text.empty()
                                     ? std::optional(ValueProblem{"expected a monitor, got \"\"", "try auto"})
                                     : std::nullopt;
                      })
                      .offering({"auto"}),
         .help =
             "fill a whole monitor: auto (the one that the window is on), its number, or part of its name",
         .also = "fullscreen projector television",
         .advice = "try auto",
         .take = into<&ViewOptions::fullScreen>},
        {.key = "screen-width",
         .value = numberValue(above(0, 1e5, "mm")),
         .help = "width of the whole monitor or projection, for parallax in millimetres",
         .also = "display size",
         .advice = "leave it out for what the monitor reports",
         .fallback = "what the monitor reports, or 500",
         .panel = OptionPanel::View,
         .take = into<&ViewOptions::screenWidth_mm>},
        {.key = "viewing-distance",
         .value = numberValue(above(0, 1e6, "mm")),
         .help = "distance from the eyes to the screen, for parallax in degrees",
         .advice = "600 is usual at a desk",
         .fallback = "600",
         .panel = OptionPanel::View,
         .take = into<&ViewOptions::viewingDistance_mm>},
    };
}

// Returns the options for how frames are made, and for what the window does from start to close.
std::vector<Option> runOptions() {
    return {
        {.key = "sweep",
         .value = wordValue({"auto", "cpu", "gpu"}),
         .help = "the processor that sweeps a medium; gpu needs OpenGL 4.5",
         .advice = "auto takes the faster one",
         .fallback = "auto, the faster one",
         .behind = "mode",
         .rules = {{[](const Asked& asked) {
                        return !asked.is("sweep", "auto") && !asked.shows(scene_type::kMedia);
                    },
                    "needs a medium", "leave it out, or show one with --medium"}},
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::sweep>},
        {.key = "shots",
         .value = fileValue(),
         .help = "folder for saved pictures and recorded flights",
         .fallback = "the current folder",
         .inFile = false,
         .take = into<&ViewOptions::shots>},
        {.key = "late-warp",
         .value = wordValue({"on", "off"}),
         .help = "while something moves: warp the newest picture, at each refresh of the monitor, to where "
                 "the eyes are now",
         .fallback = "on",
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewOptions>().lateWarp = value.text == "on"; }},
        {.key = "refine",
         .value = wordValue({"on", "off"}),
         .help = fmt::format("while nothing moves: cast both eyes in full again and again and average them, "
                             "{} rays a pixel at most",
                             kMostRaysAtRest),
         .fallback = "on",
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ViewOptions>().refine = value.text == "on"; }},
        {.key = "target-ms",
         .value = numberValue(within(1e-3, 1e6, "ms")),
         .help = "time for a frame while something moves: to keep it, frames are made smaller, and enlarged",
         .also = "fps performance rate quality",
         .advice = "33 is 30 frames a second",
         .fallback = "two refreshes of the monitor, at most 40; for a medium four times that",
         .rules = {{[](const Asked& asked) { return asked.is("late-warp", "off"); },
                    "has no effect beside --late-warp off, whose frames are whole", kLeaveItOut}},
         .panel = OptionPanel::Quality,
         .take = into<&ViewOptions::target_ms>},
        {.key = "bench",
         .value = flagValue(),
         .help = "fly --path, or up to 20 s of the scene's own flight, rest for 10 s, print how evenly "
                 "pictures came, their age and their error, and close",
         .inFile = false,
         .take = into<&ViewOptions::bench>},
        {.key = "json",
         .value = fileValue(),
         .help = "write what was done as one JSON document when the window is closed, into a file; - or no "
                 "name: to standard output",
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
