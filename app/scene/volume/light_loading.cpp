#include "app/scene/volume/light_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/options/number_text.h"
#include "app/options/output_place.h"
#include "app/scene/volume/side.h"
#include "engine/base/error.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

constexpr const char* kHashing = "checking the values";

void require(bool holds, const char* option, const std::string& problem, const std::string& advice) {
    if (!holds) throw Error(option, "", problem, advice);
}

TexelChoice choiceOf(const ColonScene& scene, const VolumeSide& side, const BakeOptions& options) {
    TexelChoice choice;
    const GreyVolume& field = scene.volume.field;
    choice.lowest = choice.highest = scene.volume.cells.isovalue;
    choice.region = side.region();
    constexpr const char* kOneWall = "needs a volume seen from outside, this one is a colon with one wall";
    if (options.isovalues) side.expectOutside("--isovalues", kOneWall);
    if (options.full) side.expectOutside("--full", kOneWall);
    if (options.isovalues) {
        const glm::dvec2 range =
            (glm::dvec2(options.isovalues->low, options.isovalues->high) - field.offset) / field.scale;
        choice.lowest = static_cast<float>(std::min(range.x, range.y));
        choice.highest = static_cast<float>(std::max(range.x, range.y));
    }
    choice.full = options.full;
    return choice;
}

glm::dvec3 centreOf(const VolumeFrame& frame) {
    return frame.worldFromVoxel(0.5 * (glm::dvec3(frame.size) - 1.0));
}

void addLamps(const ColonScene& scene, const VolumeSide& side, const LampsAsked& asked, const char* option,
              LightSetup& setup) {
    if (asked.centreline) return side.addLine(asked.spacing, option, setup);
    PointLight light;
    light.position = asked.position;
    // Intensity at which a surface in the middle of the volume that faces the light is as bright as under a
    // sky of 1.
    const glm::dvec3 away = light.position - centreOf(scene.volume.field.frame);
    const double least = std::max(glm::dot(away, away), light.radius * light.radius);
    light.intensity = glm::vec3(static_cast<float>(asked.intensity.value_or(std::numbers::pi * least)));
    setup.lights.push_back(light);
}

LightSetup setupOf(const ColonScene& scene, const VolumeSide& side, const BakeOptions& options, BakeKind kind,
                   std::vector<std::string>& notes) {
    side.checkLight(options, kind);
    LightSetup setup;
    if (options.albedo) setup.albedo = glm::vec3(*options.albedo);
    if (options.bounces) setup.bounces = *options.bounces;
    setup.reach = options.reach_mm.value_or(0) * 1e-3;
    if (kind == BakeKind::Openness) {
        setup.sky = glm::vec3(1);
        setup.bounces = 0;
        if (!options.reach_mm) setup.reach = side.usualReach(notes);
        return setup;
    }
    if (kind == BakeKind::Transfer) return setup;
    if (!options.probe.empty()) setup.probe = std::make_shared<LightProbe>(readLightProbe(options.probe));
    if (options.sky) setup.sky = *options.sky;
    for (const LampsAsked& lamps : options.lights) addLamps(scene, side, lamps, options.words.light, setup);
    if (!setup.probe && !options.sky && setup.lights.empty())
        side.addUsualLight(options.words.light, setup, notes);
    return setup;
}

}  // namespace

void checkBakeOptions(const BakeOptions& options) {
    if (options.out.empty()) return;
    checkOutputToReadAgain("--out", options.out);
    require(!isForeignFile(options.out), "--out", "\"" + options.out + "\" is there and is no bake",
            "name another file, or take it away first");
}

LightSetup lightSetupOf(const ColonScene& scene, const BakeOptions& options,
                        std::vector<std::string>& notes) {
    return setupOf(scene, *sideOf(scene), options, BakeKind::Irradiance, notes);
}

std::uint64_t contentOf(const ColonScene& scene, Progress& progress) {
    progress.report(0, kHashing);
    const std::uint64_t content = sideOf(scene)->content(progress);
    progress.report(1, kHashing);
    return content;
}

VolumeBakePlan planVolumeBake(const ColonScene& scene, const BakeOptions& options, Progress& progress) {
    const GreyVolume& field = scene.volume.field;
    VolumeBakePlan plan;
    BakeInputs& in = plan.inputs;
    in.shape.kind = options.what.value_or(BakeKind::Irradiance);
    const std::unique_ptr<const VolumeSide> side = sideOf(scene);
    in.light = setupOf(scene, *side, options, in.shape.kind, plan.notes);
    in.shape.order = options.order.value_or(in.shape.order);
    const glm::vec3 a = in.light.albedo;
    in.shape.channels = a.x == a.y && a.y == a.z ? 1 : 3;
    in.texels = texelFrame(field.frame, options.resolution.value_or(1));
    in.choice = choiceOf(scene, *side, options);
    if (!in.choice.full) {
        in.sampling.lowest = static_cast<double>(in.choice.lowest);
        in.sampling.highest = static_cast<double>(in.choice.highest);
    }
    Progress choosing(progress, 0, 0.5), hashing(progress, 0.5, 1);
    plan.bricks = wantedBricks(field, in.texels, in.choice, choosing);
    require(!plan.bricks.empty(), options.isovalues ? "--isovalues" : "SCENE",
            "no surface is there to be lit", "choose values inside the volume's");
    in.content = side->content(hashing);
    progress.report(1, kHashing);
    return plan;
}

BakedLight loadBakedLight(const std::filesystem::path& file, const ColonScene& scene, Progress& progress) {
    constexpr const char* kReading = "reading baked light";
    progress.report(0.0, kReading);
    std::string problem;
    const auto read = readBakeFile(file, std::nullopt, problem);
    if (!read)
        throw Error(file.string(), "", problem.empty() ? "there is no such bake" : problem,
                    "make one with stereonav bake");
    Progress comparing(progress, 0.3, 0.7);
    if (read->identity.content != contentOf(scene, comparing))
        throw Error(file.string(), "", "is the light of another volume",
                    scene.maskSmoothed ? "bake this one, with the same --mask-smoothing" : "bake this one");
    BakedLight light;
    light.kind = read->sums.shape().kind;
    light.error = read->sums.error();
    if (light.kind == BakeKind::Transfer) {
        light.transfer = transferOf(read->sums);
    } else {
        if (light.kind == BakeKind::Irradiance) light.unit = lightUnitOf(read->sums);
        light.irradiance = illuminationOf(read->sums, light.unit);
    }
    progress.report(1, kReading);
    return light;
}

}  // namespace stereonav
