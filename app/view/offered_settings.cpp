#include "app/view/offered_settings.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "app/scene/shown_as.h"
#include "engine/image/stereo_compose.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene_limits.h"
#include "engine/simd/simd_target.h"

namespace stereonav {
namespace {

std::vector<std::string> choicesOf(const Scene* scene, const Option& option) {
    std::vector<std::string> choices = option.value.words;
    const std::string_view key = option.key;
    if (key == "simd") {
        const std::vector<SimdTarget> sets = simdTargets();
        std::erase_if(choices, [&](const std::string& word) {
            return word != nameOf(SimdTarget::Auto) &&
                   std::none_of(sets.begin(), sets.end(),
                                [&](SimdTarget set) { return nameOf(set) == word; });
        });
    }
    if (!scene) return choices;
    if (key == "mode") {
        for (const OutputModeInfo& mode : outputModes()) choices.emplace_back(mode.shortName);
    } else if (key == "method") {
        for (const std::string_view method : scene->frames().methods()) choices.emplace_back(method);
    } else if (key == "transfer") {
        if (const auto* const surface = scene->offered<SurfaceChoices>())
            for (const std::string& name : surface->transfers)
                if (!name.empty()) choices.push_back(name);
    }
    return choices;
}

// Returns whether a rule refuses the value beside the other options.
bool isBroken(const GivenOptions& options, SceneSet type, const Option& option, const OptionValue& value) {
    GivenOptions given = options;
    given.forget(option.key);
    given.add(option.key, value, option.name());
    const Asked asked{given, type};
    return std::any_of(option.rules.begin(), option.rules.end(),
                       [&](const OptionRule& rule) { return rule.broken(asked); });
}

}  // namespace

bool isOffered(const Scene* scene, const ViewOptions& options, const Option& option) {
    const auto type = sceneTypeOf(options.scene);
    if (!type || (option.scenes & *type) == 0) return false;
    const auto* const limits = scene ? scene->offered<const SceneLimits>() : nullptr;
    if (limits && limits->refuses(option.key, "")) return false;
    // The present value, or any.
    GivenOptions given = options.scene.given;
    if (!given.has(option.key)) given.add(option.key, OptionValue{}, option.name());
    const Asked asked{given, *type};
    return std::none_of(option.rules.begin(), option.rules.end(),
                        [&](const OptionRule& rule) { return rule.broken(asked); });
}

SettingRow rowOf(const Scene* scene, const ViewOptions& options, const Option& option) {
    SettingRow row{option.value.kind, option.value.range, choicesOf(scene, option)};
    if (const auto type = sceneTypeOf(options.scene); type && !option.rules.empty())
        std::erase_if(row.choices, [&](const std::string& word) {
            OptionValue value;
            value.text = word;
            return isBroken(options.scene.given, *type, option, value);
        });
    const auto* const limits = scene ? scene->offered<const SceneLimits>() : nullptr;
    if (!limits) return row;
    if (const auto range = limits->ranges.find(option.key); range != limits->ranges.end())
        row.range = range->second;
    std::erase_if(row.choices, [&](const std::string& word) { return limits->refuses(option.key, word); });
    return row;
}

}  // namespace stereonav
