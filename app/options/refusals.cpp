#include "app/options/refusals.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "app/options/command.h"
#include "app/options/usual_words.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

struct Reason {
    std::string problem, advice;
    bool operator==(const Reason&) const = default;
};
struct Refusal {
    std::string places;  // "--isovalue, --opacity"
    Reason reason;
};

// Replaces "{model}" by the value of --model, and "{SCENE}" by the scene's name.
std::string filledIn(std::string text, const GivenOptions& given, const std::string& scene) {
    for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open)) {
        const std::size_t close = text.find('}', open);
        const std::string key = text.substr(open + 1, close - open - 1);
        const std::string value = key == "SCENE" ? scene : given.text(key);
        text.replace(open, close - open + 1, value);
        open += value.size();
    }
    return text;
}

// Returns why an option of another type of scene is refused.
Reason reasonOfType(const Option& option, SceneSet type, const std::string& scene) {
    using namespace scene_type;
    const bool medium = type & kMedia;
    if (type == kMeshFile) return {"has no effect on a mesh", kLeaveItOut};
    if (!option.elsewhere.problem.empty()) return {option.elsewhere.problem, option.elsewhere.advice};
    if (!medium && !(option.scenes & ~kMedia))
        return {"needs a medium", "add --medium, or show cloud or wax"};
    if (type == kTerrainMedium && option.scenes & kTerrain)
        return {"does not go with a terrain shown as a medium", kLeaveItOut};
    if (!(option.scenes & ~(kTerrains | kMeshFile)))
        return {medium && !(option.scenes & ~kMedia) ? "only for terrains"
                : type == kBuiltInMedium             ? fmt::format("only for terrains, {} is a medium", scene)
                                                     : "only for terrains, the scene is a CT study",
                kLeaveItOut};
    if (type & kTerrains)
        return {"only for CT studies and the built-in colon, the scene is a terrain", kLeaveItOut};
    if (type & (kColon | kColonMedium) && option.scenes & kStudies)
        return {"only for studies in files, the built-in colon has none", kLeaveItOut};
    if (medium && option.scenes & kSurfaces && !(option.scenes & kMedia))
        return {"does not go with a medium, which has its own",
                type == kBuiltInMedium ? kLeaveItOut : "leave it out, or leave out --medium"};
    return {fmt::format("only for CT studies, {} is built in", scene), kLeaveItOut};
}

std::optional<Reason> reasonAgainst(const Option& option, const Asked& asked, const std::string& scene) {
    if (asked.type != 0 && !(option.scenes & asked.type)) return reasonOfType(option, asked.type, scene);
    for (const Exclusion& other : option.excludes)
        if (asked.has(other.key))
            return Reason{fmt::format("does not go with --{}", other.key), other.advice};
    for (const OptionRule& rule : option.rules)
        if (rule.broken(asked))
            return Reason{filledIn(rule.problem, asked.given, scene),
                          filledIn(rule.advice, asked.given, scene)};
    return std::nullopt;
}

void add(std::vector<Refusal>& refusals, const std::string& place, Reason reason) {
    const auto same = std::find_if(refusals.begin(), refusals.end(),
                                   [&](const Refusal& refusal) { return refusal.reason == reason; });
    if (same != refusals.end())
        same->places += ", " + place;
    else
        refusals.push_back({place, std::move(reason)});
}

}  // namespace

void refuseWhatDoesNotApply(const GivenOptions& given, SceneSet type, const std::string& scene) {
    const Asked asked{given, type};
    std::vector<Refusal> refusals;
    for (const Option& option : optionTable()) {
        if (!(option.commands & given.command)) continue;
        const GivenOptions::Given* is = given.find(option.key);
        if (!is) continue;
        if (const std::optional<Reason> reason = reasonAgainst(option, asked, scene))
            add(refusals, is->place, *reason);
    }
    if (refusals.empty()) return;
    // The first refusal has the form of an error message; the others follow in the same form.
    std::string rest;
    for (std::size_t n = 1; n < refusals.size(); ++n)
        rest += fmt::format(". {}: {}; {}", refusals[n].places, refusals[n].reason.problem,
                            refusals[n].reason.advice);
    const Refusal& first = refusals.front();
    throw Error(first.places, "", first.reason.problem, first.reason.advice + rest);
}

void refuseWhatDoesNotApply(const SceneOptions& options, std::optional<SceneSet> type) {
    // A scene that the command does not take at all is reported by the command itself.
    if (options.given.command == 0 || !type || !(commandOf(options.given.command).scenes & *type)) return;
    refuseWhatDoesNotApply(options.given, *type, options.scene);
}

}  // namespace stereonav
