// Options: the instruments of colons.
#include "app/options/option_numbers.h"
#include "app/options/option_table.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "engine/camera/view_ranges.h"

namespace stereonav {
namespace {

std::vector<Option> coverageOptions() {
    using command::kCoverage;
    return {
        {.key = "fov",
         .value = numberValue(kFovRange),
         .help = "vertical field of view",
         .advice = "90 to 140 is usual",
         .fallback = "the scene's own",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { to.scene->fov_deg = value.number(); }},
        {.key = "size",
         .value = sizeValue(),
         .help = "of the picture: its shape alone counts",
         .advice = "try 1280x720",
         .fallback = "512x512",
         .commands = kCoverage,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 *to.size = {static_cast<int>(value.numbers[0]), static_cast<int>(value.numbers[1])};
             }},
        {.key = "path",
         .value = fileValue(),
         .help = "a recorded path (.gltf, .glb, .path)",
         .fallback = "along the centreline",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.path = value.text; }},
        {.key = "step",
         .value = numberValue(within(0.1, 100, "mm")),
         .help = "between the places of the flight that are looked from",
         .advice = "2 is fine",
         .fallback = "2",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { to.coverage->step_mm = value.number(); }},
        {.key = "within",
         .value = numberValue(above(0, 1e6, "mm")),
         .help = "how far from the eye wall counts as seen",
         .advice = "100 is two widths of a colon",
         .fallback = "100",
         .commands = kCoverage,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.coverage->within_mm = value.number(); }},
        {.key = "angle",
         .value = numberValue(above(0, 90, "degrees")),
         .help = "how far off its normal wall counts as seen",
         .advice = "90 leaves nothing out that is on screen",
         .fallback = "85",
         .commands = kCoverage,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.coverage->angle_deg = value.number(); }},
        {.key = "patch",
         .value = numberValue(within(0, 1e9, "mm^2")),
         .help = "the smallest unseen patch that is listed and looked at",
         .advice = "300 is usual in the literature",
         .fallback = "300",
         .commands = kCoverage,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.coverage->patch_mm2 = value.number(); }},
        {.key = "out",
         .value = fileValue(),
         .help = "the unseen patches as a table, .csv or -",
         .commands = kCoverage,
         .take = [](OptionTargets& to, const OptionValue& value) { *to.out = value.text; }},
    };
}

}  // namespace

std::vector<Option> colonInstrumentOptions() {
    std::vector<Option> all;
    for (std::vector<Option> part : {coverageOptions()})
        for (Option& option : part) all.push_back(std::move(option));
    return all;
}

}  // namespace stereonav
