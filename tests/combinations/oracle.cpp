#include "tests/combinations/oracle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "colon/scene/colon_scene.h"
#include "engine/base/parallel.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/scene/capabilities.h"
#include "tests/oracle/plain_composite.h"
#include "tests/oracle/plain_sweep.h"

namespace stereonav::test {
namespace {

OraclePicture blank(const EyeView& view) {
    return {view.width, view.height,
            std::vector<glm::dvec3>(static_cast<std::size_t>(view.width) * view.height)};
}

// Returns whether anything lies between the lamp and a place on the surface, from half a voxel before it.
bool inShadow(const VolumeScene& volume, const glm::dvec3& position, const glm::dvec3& lamp) {
    const glm::dvec3 spacing = volume.field.frame.spacing;
    const glm::dvec3 way = lamp - position;
    const double length = glm::length(way);
    const double before = 0.5 * std::min({spacing.x, spacing.y, spacing.z}) / length;
    const PlainHit hit = castPlainVolume(volume.field, volume.cells.isovalue, {position, way, before});
    return hit.hit() && hit.t < 1;
}

glm::dvec3 surfaceLight(const VolumeScene& volume, const EyeView& view, const glm::dvec3& lamp,
                        const PlainRay& ray, const PlainHit& hit) {
    VolumeLook look = volume.look;
    const glm::dvec3 position = ray.eye + hit.t * ray.direction;
    const glm::dvec3 normal = plainNormal(volume.field, hit.voxel());
    if (look.shadows && inShadow(volume, position, lamp)) look.diffuse = look.specular = 0;
    glm::dvec3 light =
        lightPlain(look, volume.field.frame, hit.voxel(), normal, lamp, view.eye, glm::dvec3(look.surface));
    if (look.fog > 0)
        light = glm::mix(glm::dvec3(look.background), light,
                         std::exp(-glm::length(position - view.eye) / static_cast<double>(look.fog)));
    return light;
}

glm::dvec3 volumeLight(const VolumeScene& volume, const EyeView& view, int x, int y) {
    const VolumeLook& look = volume.look;
    const glm::dvec3 lamp = look.lampAt.value_or(view.head), background(look.background);
    PlainRay ray{view.eye, view.rayDirection(x + 0.5, y + 0.5), 0.0};
    if (look.transfer.empty()) {
        ray.nearDepth = view.nearDepth;
        const PlainHit hit = castPlainVolume(volume.field, volume.cells.isovalue, ray);
        return hit.hit() ? surfaceLight(volume, view, lamp, ray, hit) : background;
    }
    ray.nearDepth = view.nearDepth;
    const PlainComposite sum = integratePlain(volume.field, look, ray, lamp);
    // The kernels ignore the rest in the same way: it is too little to be seen.
    return sum.color + (sum.left < 1.0 / 1024 ? 0.0 : sum.left) * background;
}

}  // namespace

std::optional<OraclePicture> castByOracle(const Scene& scene, const EyeView& view) {
    const auto* const colon = scene.offered<const ColonScene>();
    if (!colon || !scene.offered<RayCast>() || scene.offered<PictureLight>()) return std::nullopt;
    OraclePicture picture = blank(view);
    parallelFor(view.height, [&](int y) {
        for (int x = 0; x < view.width; ++x)
            picture.light[static_cast<std::size_t>(y) * view.width + x] =
                volumeLight(colon->volume, view, x, y);
    });
    return picture;
}

std::vector<OraclePicture> sweptByOracle(const Scene& scene, const std::vector<EyeView>& eyes) {
    if (!scene.offered<MediumScene>()) return {};
    const MediumScene& shown = *scene.offered<MediumScene>();
    const bool surface = shown.look.model == MediumModel::Surface && shown.makeSurface;
    const Medium made = surface ? shown.makeSurface() : Medium();
    const Medium& medium = surface ? made : shown.medium;
    const SweepGeometry geometry = makeSweepGeometry(medium, shown.look, shown.sweep, eyes, eyes[0].head);
    const std::vector<MediumPicture> pictures = plainSweep(medium, shown.look, shown.sweep, geometry);
    std::vector<OraclePicture> oracles;
    for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
        const EyeView& view = eyes[eye];
        OraclePicture picture = blank(view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::vec4 light = pictures[eye].light.at(x, y);
                const glm::vec3 behind = shown.sky
                                             ? shown.sky(glm::normalize(view.rayDirection(x + 0.5, y + 0.5)))
                                             : shown.look.background;
                picture.light[static_cast<std::size_t>(y) * view.width + x] =
                    glm::dvec3(shown.tone(glm::vec3(light) + light.w * behind));
            }
        oracles.push_back(std::move(picture));
    }
    return oracles;
}

EyeImage packed(const OraclePicture& oracle, std::string& problem) {
    EyeImage image;
    image.resize(oracle.width, oracle.height);
    for (int y = 0; y < oracle.height; ++y)
        for (int x = 0; x < oracle.width; ++x) {
            const glm::dvec3& light = oracle.at(x, y);
            if (!std::isfinite(light.x + light.y + light.z))
                problem = fmt::format("the oracle itself has no number at {},{}", x, y);
            image.color.at(x, y) = packColor(glm::vec3(light));
        }
    return image;
}

}  // namespace stereonav::test
