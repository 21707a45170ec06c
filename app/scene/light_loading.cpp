#include "app/scene/light_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/options/number_text.h"
#include "app/output/output_place.h"
#include "engine/base/error.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

constexpr double kLightSpacing = 0.05;     // metres along a colon's centreline
constexpr std::size_t kMostLights = 4096;  // each costs a shadow ray at every vertex of every path

void require(bool holds, const char* option, const std::string& problem, const std::string& advice) {
    if (!holds) throw Error(option, "", problem, advice);
}

TexelChoice choiceOf(const ColonScene& scene, const BakeOptions& options) {
    TexelChoice choice;
    const GreyVolume& field = scene.volume.field;
    choice.lowest = choice.highest = scene.volume.cells.isovalue;
    if (scene.isColon()) choice.region = &scene.lumen.lumen;
    const auto onlySurfaces = [&](bool given, const char* option) {
        require(!given || !scene.isColon(), option,
                "expected with a volume seen from outside, this one is a colon with one wall",
                "add --isosurface, or leave it out");
    };
    onlySurfaces(options.isovalues.has_value(), "--isovalues");
    onlySurfaces(options.full, "--full");
    if (options.isovalues) {
        const glm::dvec2 range =
            (glm::dvec2(options.isovalues->low, options.isovalues->high) - field.offset) / field.scale;
        choice.lowest = static_cast<float>(std::min(range.x, range.y));
        choice.highest = static_cast<float>(std::max(range.x, range.y));
    }
    choice.full = options.full;
    return choice;
}

double meanRadius(const std::vector<CentrelinePoint>& points) {
    double radius = 0;
    for (const CentrelinePoint& point : points) radius += point.radius / static_cast<double>(points.size());
    return radius;
}

// Lights that make a wall as far away as the lumen is wide on average as bright as a sky of 1 would.
void addCentreline(const ColonScene& scene, double spacing, const char* option, LightSetup& setup) {
    require(scene.isColon(), option, "expected a colon for lights along the centreline, this volume is none",
            "give their places as x,y,z");
    const std::vector<CentrelinePoint>& points = scene.centreline.points;
    const double radius = meanRadius(points);
    const auto intensity = static_cast<float>(std::numbers::pi * radius * radius);
    if (spacing == kLightSpacing) spacing = std::min(spacing, scene.centreline.length());  // one at least
    double along = 0.5 * spacing;  // since the last light
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (n > 0) along += glm::length(points[n].position - points[n - 1].position);
        // Where the path crosses tissue there is no room for a light.
        if (along < spacing || !(scene.freeDistanceAt(points[n].position, 1e-3) > 0)) continue;
        require(setup.lights.size() < kMostLights, option,
                fmt::format("the centreline would get more than {} lights", kMostLights),
                "choose a larger distance");
        PointLight light;
        light.position = points[n].position;
        light.intensity = glm::vec3(intensity);
        setup.lights.push_back(light);
        along = 0;
    }
    require(!setup.lights.empty(), option, "the centreline is shorter than the lights' distance",
            "choose a smaller distance");
}

glm::dvec3 centreOf(const VolumeFrame& frame) {
    return frame.worldFromVoxel(0.5 * (glm::dvec3(frame.size) - 1.0));
}

void addLamps(const ColonScene& scene, const LampsAsked& asked, const char* option, LightSetup& setup) {
    if (asked.centreline) return addCentreline(scene, asked.spacing.value_or(kLightSpacing), option, setup);
    PointLight light;
    light.position = asked.position;
    // So that a surface in the middle of the volume that faces it is as bright as under a sky of 1.
    const glm::dvec3 away = light.position - centreOf(scene.volume.field.frame);
    const double least = std::max(glm::dot(away, away), light.radius * light.radius);
    light.intensity = glm::vec3(static_cast<float>(asked.intensity.value_or(std::numbers::pi * least)));
    setup.lights.push_back(light);
}

LightSetup setupOf(const ColonScene& scene, const BakeOptions& options, BakeKind kind,
                   std::vector<std::string>& notes) {
    LightSetup setup;
    if (options.albedo) setup.albedo = glm::vec3(*options.albedo);
    if (options.bounces) setup.bounces = *options.bounces;
    setup.reach = options.reach_mm.value_or(0) * 1e-3;
    if (kind == BakeKind::Openness) {
        setup.sky = glm::vec3(1);
        setup.bounces = 0;
        if (scene.isColon() && !options.reach_mm && !scene.centreline.points.empty()) {
            // A plain tube is open then, and folds and the foot of a polyp are not.
            setup.reach = meanRadius(scene.centreline.points);
            notes.push_back(fmt::format("open is what meets no wall within {:.1f} mm, the mean radius",
                                        1e3 * setup.reach));
        }
        return setup;
    }
    if (kind == BakeKind::Transfer) return setup;
    if (!options.probe.empty()) setup.probe = std::make_shared<LightProbe>(readLightProbe(options.probe));
    if (options.sky) setup.sky = *options.sky;
    for (const LampsAsked& lamps : options.lights) addLamps(scene, lamps, options.words.light, setup);
    if (setup.probe || options.sky || !setup.lights.empty()) return setup;
    if (scene.isColon()) {
        addCentreline(scene, kLightSpacing, options.words.light, setup);
        notes.push_back(fmt::format("lit by {} lights along the centreline, {:g} mm apart",
                                    setup.lights.size(), 1e3 * kLightSpacing));
    } else {
        setup.sky = glm::vec3(1);
        notes.push_back("lit by a white sky all around");
    }
    return setup;
}

// Light from outside never gets into a closed colon, unless rays are asked no further than so far.
void refuseOutsideLight(const ColonScene& scene, const BakeOptions& options, BakeKind kind) {
    if (!scene.isColon() || options.reach_mm) return;
    const std::string advice =
        fmt::format("{}{} centreline, or --reach",
                    kind == BakeKind::Irradiance ? "add " : "bake irradiance with ", options.words.light);
    require(kind != BakeKind::Transfer, "--what",
            fmt::format("{} is 0 everywhere inside a colon, which is closed", nameOf(kind)), advice);
    require(kind == BakeKind::Openness || !options.lights.empty() || (options.probe.empty() && !options.sky),
            options.probe.empty() ? "--sky" : options.words.probe,
            "nothing of it is seen inside a colon, which is closed", advice);
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
    refuseOutsideLight(scene, options, BakeKind::Irradiance);
    return setupOf(scene, options, BakeKind::Irradiance, notes);
}

std::uint64_t contentOf(const ColonScene& scene, Progress& progress) {
    const GreyVolume& field = scene.volume.field;
    if (!scene.isColon()) return contentHash(field);
    TexelChoice wall;
    wall.lowest = wall.highest = scene.volume.cells.isovalue;
    wall.region = &scene.lumen.lumen;
    return contentHashNear(field, scene.lumen.lumen, wantedBricks(field, field.frame, wall, progress));
}

VolumeBakePlan planVolumeBake(const ColonScene& scene, const BakeOptions& options, Progress& progress) {
    const GreyVolume& field = scene.volume.field;
    VolumeBakePlan plan;
    BakeInputs& in = plan.inputs;
    in.shape.kind = options.what.value_or(BakeKind::Irradiance);
    refuseOutsideLight(scene, options, in.shape.kind);
    in.light = setupOf(scene, options, in.shape.kind, plan.notes);
    in.shape.order = options.order.value_or(in.shape.order);
    const glm::vec3 a = in.light.albedo;
    in.shape.channels = a.x == a.y && a.y == a.z ? 1 : 3;
    in.texels = texelFrame(field.frame, options.resolution.value_or(1));
    in.choice = choiceOf(scene, options);
    if (!in.choice.full) {
        in.sampling.lowest = static_cast<double>(in.choice.lowest);
        in.sampling.highest = static_cast<double>(in.choice.highest);
    }
    plan.bricks = wantedBricks(field, in.texels, in.choice, progress);
    require(!plan.bricks.empty(), options.isovalues ? "--isovalues" : "SCENE",
            "no surface is there to be lit", "choose values inside the volume's");
    in.content = contentOf(scene, progress);
    return plan;
}

BakedLight loadBakedLight(const std::filesystem::path& file, const ColonScene& scene, Progress& progress) {
    progress.report(0.0, "reading baked light");
    std::string problem;
    const auto read = readBakeFile(file, std::nullopt, problem);
    if (!read)
        throw Error(file.string(), "", problem.empty() ? "there is no such bake" : problem,
                    "make one with stereonav bake");
    if (read->identity.content != contentOf(scene, progress))
        throw Error(file.string(), "", "is the light of another volume", "bake this one");
    BakedLight light;
    light.kind = read->sums.shape().kind;
    light.error = read->sums.error();
    if (light.kind == BakeKind::Transfer) {
        light.transfer = transferOf(read->sums);
    } else {
        if (light.kind == BakeKind::Irradiance) light.unit = lightUnitOf(read->sums);
        light.irradiance = illuminationOf(read->sums, light.unit);
    }
    return light;
}

}  // namespace stereonav
