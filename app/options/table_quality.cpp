// Options: how exact the right eye is.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

#include "app/options/option_table.h"
#include "app/options/option_take.h"
#include "app/options/usual_words.h"
#include "engine/frame/refined_frames.h"
#include "engine/sampling/edge_rays.h"
#include "engine/stereo/quality_plan.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {
namespace {

using namespace command;
using namespace scene_type;

constexpr CommandSet kDialled = kRender | kPlay | kView;

OptionRule notOfMedia() {
    return {nullptr, "does not go with a medium, whose eyes are swept together",
            "choose --slices and --light-size instead"};
}

OptionRule notOfTracedLight() {
    return {[](const Asked& asked) { return asked.is("light", "traced"); }, "does not go with --light traced",
            "choose --samples instead"};
}

// Returns "linear, cubic or selective".
std::string dialledMethods() {
    std::vector<std::string_view> names;
    for (const NamedMethod& named : kRightEyeMethods)
        if (hasQualityDial(named.method)) names.push_back(named.name);
    const std::string_view last = names.back();
    names.pop_back();
    return fmt::format("{} or {}", fmt::join(names, ", "), last);
}

std::vector<OptionRule> qualityRules() {
    return {
        {[](const Asked& asked) { return asked.is("light", "traced") && asked.shows(kSurfaces); },
         "does not go with --light traced", "leave it out: nothing is warped"},
        {[](const Asked& asked) {
             const auto method = rightEyeMethodFromName(asked.given.text("method"));
             return method && !hasQualityDial(*method);
         },
         "does not go with the method {method}", "choose " + dialledMethods() + ", or leave the method out"}};
}

}  // namespace

std::vector<Option> qualityOptions() {
    return {
        {.key = "quality",
         .value = numberValue(within(0, 1)),
         .help = "share of the warp's expected squared error to remove by casting; 1 casts every pixel",
         .advice = "0 casts the holes alone, 1 every pixel",
         .group = kQualityGroup,
         .commands = kDialled,
         .scenes = kCast,
         .elsewhere = notOfMedia(),
         .rules = qualityRules(),
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::quality, &QualityOptions::quality>},
        {.key = "target-psnr",
         .value = numberValue(within(1, kMostPsnr_db, "dB")),
         .help = "PSNR against a full cast that 95 of 100 frames are to reach",
         .advice = "40 is good, 50 hard to see",
         .group = kQualityGroup,
         .commands = kDialled,
         .scenes = kCast,
         .elsewhere = notOfMedia(),
         .rules = qualityRules(),
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::quality, &QualityOptions::targetPsnr_db>},
        {.key = "target-ms",
         .value = numberValue(within(1e-3, 1e6, "ms")),
         .help = "time for a frame, both eyes: fewer pixels are cast, or pictures made smaller, to keep it",
         .advice = "33 is 30 frames a second",
         .group = kQualityGroup,
         .commands = kRender | kPlay,
         .scenes = kCast,
         .elsewhere = notOfMedia(),
         .rules = qualityRules(),
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::quality, &QualityOptions::target_ms>},
        {.key = "edges",
         .value = wholeValue(within(0, kMostEdgeRays, "rays")),
         .help = "rays added to each pixel at an edge, in both eyes; 0: jagged edges, in less time",
         .also = "antialiasing smooth jagged",
         .advice = "4 smooths them, 16 is fine",
         .group = kQualityGroup,
         .fallback = "4; with compare 0",
         .commands = kDialled | kCompare,
         .scenes = kCast,
         .elsewhere = notOfMedia(),
         .rules = {notOfTracedLight()},
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::quality, &QualityOptions::edges>},
        {.key = "ground-detail",
         .value = wordValue({"on", "off"}),
         .help = "shading of relief finer than a terrain's samples, made by a fractal; silhouettes and "
                 "depths stay",
         .group = kQualityGroup,
         .fallback = "on; with compare and --bench off",
         .commands = kDialled | kCompare,
         .scenes = kTerrains,
         .rules = {{[](const Asked& asked) { return asked.shows(kTerrainMedium); },
                    "does not go with a terrain shown as a medium", kLeaveItOut}},
         .panel = OptionPanel::Quality,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->groundDetail = value.text == "on"; }},
        {.key = "level-of-detail",
         .value = numberValue(within(0, 16, "of a pixel")),
         .help = "cast distant ground from coarser samples where their error in height is at most this share "
                 "of a pixel; 0: never",
         .also = "lod resolution performance",
         .advice = "0.5 is not seen",
         .group = kQualityGroup,
         .fallback = "0",
         .commands = kDialled | kCompare,
         .scenes = kTerrain,
         .panel = OptionPanel::Quality,
         .take = into<&SceneOptions::levelOfDetail>},
        {.key = "rays",
         .value = wholeValue(within(1, kMostRays, "rays")),
         .help = "rays in every pixel, spread evenly over it",
         .also = "antialiasing supersampling samples msaa smooth",
         .advice = "16 is fine, 64 is hard to tell from the truth",
         .group = kQualityGroup,
         .fallback = "1",
         .commands = kRender | kPlay,
         .excludes = {{"edges"}},
         .rules = {notOfTracedLight()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.rays->rays = static_cast<int>(value.whole); }},
    };
}

}  // namespace stereonav
