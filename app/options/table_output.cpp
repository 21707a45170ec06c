// Options: size, path, method and mode of pictures; what is told.
#include "app/options/offered_words.h"
#include "app/options/option_table.h"
#include "app/options/usual_words.h"
#include "engine/image/stereo_picture_file.h"

namespace stereonav {
namespace {

using namespace command;
using namespace scene_type;

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

std::vector<Option> pictureOptions() {
    return {
        {.key = "size",
         .value = sizeValue(),
         .help = "size of the picture of one eye",
         .advice = "try 1280x720",
         .fallback = "1280x720",
         .commands = kInfo | kRender | kPlay | kView,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 *to.size = {static_cast<int>(value.numbers[0]), static_cast<int>(value.numbers[1])};
             }},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path)",
         .fallback = "the scene's own",
         .commands = kPlay | kCompare,
         .inFile = false,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.path = value.text; }},
        {.key = "method",
         .value = textValue().offering(methodWords()),
         .help = "how the right eye is made, or both eyes of a medium",
         .fallback = "auto, the best",
         .commands = kRender | kPlay,
         .rules = {{[](const Asked& asked) {
                        return asked.is("light", "traced") && asked.shows(kSurfaces) &&
                               !asked.is("method", "auto") && !asked.is("method", "full");
                    },
                    "{method} does not go with --light traced", "leave it out: each eye is traced in full"}},
         .take = [](OptionTargets& to, const OptionValue& value) { *to.method = value.text; }},
        {.key = "mode",
         .value = textValue().checked(problemOfFileMode).offering(modeWords(false)),
         .help = "how two eyes become one picture: ml, mr, sbsl, sbsr, tbl, irl, arcd, ...",
         .fallback = "sbsl",
         .commands = kRender | kPlay,
         .rules = {{[](const Asked& asked) {
                        return asked.has("hash") && !asked.has("out") && !asked.has("video");
                    },
                    "has no effect on --hash, which covers both eyes", kLeaveItOut},
                   {rendersJpsOtherwise,
                    "{mode} does not go with --out {out}: a .jps has the right eye on the left",
                    "leave it out, say sbsr, or write a .jpg"},
                   {rendersMpo,
                    "{mode} does not go with --out {out}: a .mpo has each eye as a picture of its own",
                    "leave it out, or write a .jpg"}},
         .panel = OptionPanel::View,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 *to.mode = outputModeFromName(value.text).value_or(OutputMode::SideBySide);
             }},
    };
}

std::vector<Option> tellingOptions() {
    return {
        {.key = "json",
         .value = flagValue(),
         .help = "print what was done, or found, as one JSON document on standard output",
         .commands = kTelling,
         .inFile = false,
         .take = [](OptionTargets& to, const OptionValue&) { to.telling->json = true; }},
        {.key = "quiet",
         .value = flagValue(),
         .help = "print results and errors only, no progress and no notes",
         .commands = command::kAll,
         .inFile = false,
         .take = [](OptionTargets& to, const OptionValue&) { to.telling->quiet = true; }},
    };
}

}  // namespace stereonav
