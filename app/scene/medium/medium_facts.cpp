#include "app/scene/medium/medium_facts.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "app/scene/type/held_facts.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/pages.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

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

// Returns the memory of the medium; a field that a volume's scene holds is counted there.
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

Facts factsOfMedium(const Scene& loaded) {
    const MediumScene& scene = *loaded.offered<MediumScene>();
    const WorldBox& box = scene.medium.bounds();
    const glm::dvec3 size = box.empty() ? glm::dvec3(0.0) : box.high - box.low;
    FactList list;
    const bool baked = scene.look.baked.light != nullptr, animated = scene.animated();
    const std::string model(nameOf(scene.look.model)), light = lightText(scene.look.light);
    list.both("transfer", scene.transfer, "transfer");
    list.both("model", model, "model", fmt::format("{}, phase function {}", model, scene.phase));
    list.json("phase", scene.phase);
    list.both("light", light, "light", light + (baked ? ", and baked light" : ""));
    list.both("noise", scene.noise, "noise", scene.noise + (animated ? ", moving" : ""));
    list.json("animated", animated);
    const std::int64_t layers = countOf(scene.medium.layers().size());
    if (layers > 0)
        list.both("layers", layers, "layers");
    else
        list.json("layers", layers);
    list.both("extent_m", FactNumbers{size.x, size.y, size.z}, "extent",
              box.empty()
                  ? "nothing is visible"
                  : fmt::format("{} x {} x {}", lengthText(size.x), lengthText(size.y), lengthText(size.z)),
              "m");
    list.json("largest_extinction_per_m", scene.medium.largestExtinction(), "1/m");
    list.json("baked_light", baked);
    if (!scene.tone.plain())
        list.both("white", scene.tone.white, "white",
                  fmt::format("light of {:.3g} is shown as white, light above {:.1f} is compressed",
                              scene.tone.white, scene.tone.knee()));
    const SweepSetting& sweep = scene.sweep;
    const double cone = sweep.coneAngle * 180 / std::numbers::pi;
    list.json("slices", sweep.slices);
    list.json("light_size", sweep.lightSize);
    list.json("cone_deg", cone, "degrees");
    list.text("sweep", fmt::format("{} slices, light of {} x {} texels, cone of {:.0f} degrees", sweep.slices,
                                   sweep.lightSize, sweep.lightSize, cone));
    list.json("shading_width_voxels", sweep.shadingWidth, "voxels");
    const std::string memory = addHeld(list.facts(), heldBy(loaded));
    list.text("memory", memory);
    list.json("notes", scene.notes);
    for (const std::string& note : scene.notes) list.text("note", note);
    return std::move(list.facts());
}

}  // namespace stereonav
