// A medium as `info` describes it.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "app/command/info_text.h"
#include "app/output/length_text.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/pages.h"
#include "engine/medium/sweep/medium_scene.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

std::string lightText(const MediumLight& light) {
    constexpr double kDegrees = 180 / std::numbers::pi;
    if (light.kind == MediumLight::Kind::Lamp)
        return light.atHead ? "a lamp at the head"
                            : fmt::format("a lamp at {:.6g}, {:.6g}, {:.6g} m", light.position.x,
                                          light.position.y, light.position.z);
    const glm::dvec3 from = -light.direction;
    return fmt::format("from {:.0f} degrees, {:.0f} high",
                       std::fmod(std::atan2(from.x, from.y) * kDegrees + 360, 360),
                       std::asin(std::clamp(from.z, -1.0, 1.0)) * kDegrees);
}

// A field that a volume's scene holds is counted there.
std::vector<Held> heldBy(const Scene& loaded) {
    const Medium& medium = loaded.offered<MediumScene>()->medium;
    const auto* const volume = loaded.offered<const ColonScene>();
    std::vector<Held> held;
    const auto add = [&](const char* what, std::size_t bytes) {
        if (bytes > 0) held.push_back({what, bytes});
    };
    if (const GreyVolume* field = medium.field(); field && !(volume && field == &volume->volume.field))
        add("field", residentBytes(field->values));
    std::size_t heights = 0;
    for (const HeightLayer& layer : medium.layers())
        for (const Plane<float>& level : layer.levels)
            heights += sizeof(float) * static_cast<std::size_t>(level.width()) * level.height();
    add("heights", heights);
    EyePair frame;
    loaded.frames().make(loaded.viewsAt(loaded.startPose), 0, {}, frame);
    for (const HeldBytes& part : loaded.frames().held()) add(part.what, part.bytes);
    return held;
}

}  // namespace

Json mediumJson(const Scene& loaded) {
    const MediumScene& scene = *loaded.offered<MediumScene>();
    const WorldBox& box = scene.medium.bounds();
    const glm::dvec3 size = box.empty() ? glm::dvec3(0.0) : box.high - box.low;
    Json json;
    json["transfer"] = scene.transfer;
    json["model"] = std::string(nameOf(scene.look.model));
    json["phase"] = scene.phase;
    json["light"] = lightText(scene.look.light);
    json["noise"] = scene.noise;
    json["animated"] = scene.animated();
    json["layers"] = scene.medium.layers().size();
    json["extent_m"] = {size.x, size.y, size.z};
    json["largest_extinction_per_m"] = scene.medium.largestExtinction();
    json["baked_light"] = scene.look.baked.light != nullptr;
    json["slices"] = scene.sweep.slices;
    json["light_size"] = scene.sweep.lightSize;
    json["cone_deg"] = scene.sweep.coneAngle * 180 / std::numbers::pi;
    json["shading_width_voxels"] = scene.sweep.shadingWidth;
    const std::vector<Held> held = heldBy(loaded);
    json["bytes"] = bytesOf(held);
    json["held"] = heldJson(held);
    json["notes"] = scene.notes;
    return json;
}

std::string mediumText(const Scene& loaded) {
    const MediumScene& scene = *loaded.offered<MediumScene>();
    const WorldBox& box = scene.medium.bounds();
    std::string text = "medium\n";
    const auto line = [&](const char* name, const std::string& value) { text += infoLine(name, value); };
    line("transfer", scene.transfer);
    line("model", fmt::format("{}, phase function {}", nameOf(scene.look.model), scene.phase));
    line("light", lightText(scene.look.light) + (scene.look.baked.light ? ", and baked light" : ""));
    line("noise", scene.noise + (scene.animated() ? ", moving" : ""));
    if (!scene.medium.layers().empty()) line("layers", std::to_string(scene.medium.layers().size()));
    if (box.empty()) {
        line("extent", "nothing is visible");
    } else {
        const glm::dvec3 size = box.high - box.low;
        line("extent",
             fmt::format("{} x {} x {}", lengthText(size.x), lengthText(size.y), lengthText(size.z)));
    }
    line("sweep", fmt::format("{} slices, light of {} x {} texels, cone of {:.0f} degrees",
                              scene.sweep.slices, scene.sweep.lightSize, scene.sweep.lightSize,
                              scene.sweep.coneAngle * 180 / std::numbers::pi));
    line("memory", heldText(heldBy(loaded)));
    for (const std::string& note : scene.notes) line("note", note);
    return text;
}

}  // namespace stereonav
