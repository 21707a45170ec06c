// Media from both sides: a slab under light from the eye's side looks as it does from the other one with
// light there, and a surface whose values fall outwards looks as one whose values grow.
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "engine/medium/sweep/medium_sweep.h"
#include "engine/simd/simd_target.h"
#include "sweep_scenes.h"
#include "tests/oracle/plain_sweep.h"

namespace stereonav {
namespace {

using test::makeField;
using test::sun;
using test::viewFrom;

constexpr int kSidesVoxels = 25, kSidesPicture = 24;

MediumMaterial skinOf(double opacity, float surface) {
    MediumMaterial skin;
    skin.color = {0.9f, 0.6f, 0.4f};
    skin.opacity = opacity;
    skin.transport = {0.9f, 0.7f, 0.6f};
    skin.surface = surface;
    return skin;
}

// A lens of flesh, thin across z, the same on both of its sides. Its values are highest inside, or lowest
// there.
Medium lensOf(bool fallsOutwards, float surface) {
    const auto value = [&](const glm::ivec3& v) {
        const glm::dvec3 at = (glm::dvec3(v) - 0.5 * (kSidesVoxels - 1)) / glm::dvec3(11, 9, 4);
        const double inside = 1000 * glm::smoothstep(0.0, 1.0, 1.4 - glm::length(at));
        return fallsOutwards ? inside : 1000 - inside;
    };
    const MediumMaterial none = [] {
        MediumMaterial clear;
        clear.opacity = 0;
        return clear;
    }();
    const MediumMaterial skin = skinOf(0.5, surface);
    std::vector<MediumPoint> points = {{0, none}, {300, none}, {600, skin}, {1000, skin}};
    if (!fallsOutwards) points = {{0, skin}, {400, skin}, {700, none}, {1000, none}};
    return Medium(makeField(glm::ivec3(kSidesVoxels), 2, {0, 0, 0}, value),
                  MediumTransfer(points, 0.1, "test"));
}

// Returns a view from above (1) or below (-1), with y upwards, so that columns are mirrored.
EyeView lensView(int side) {
    EyeView view = viewFrom({0, 0, side * 5.0}, {0, 0, 0}, 0.25, kSidesPicture, kSidesPicture);
    view.up = {0, 1, 0};
    view.right = {static_cast<double>(side), 0, 0};
    return view;
}

// The light of a picture by the kernels of a set; none: by the plain sweep.
Plane<glm::vec4> lightSeen(const Medium& medium, const EyeView& eye, const MediumLook& look,
                           const std::optional<SimdTarget>& target) {
    SweepSetting setting;
    setting.slices = 160;
    setting.lightSize = 24;
    if (!target)
        return plainSweep(medium, look, setting,
                          makeSweepGeometry(medium, look, setting, {&eye, 1}, eye.head))
            .at(0)
            .light;
    MediumSweep sweep(medium, *target);
    MediumPicture picture;
    sweep.render(look, setting, {&eye, 1}, eye.head, 0, {&picture, 1});
    return picture.light;
}

std::vector<std::optional<SimdTarget>> waysToSweep() {
    std::vector<std::optional<SimdTarget>> all = {std::nullopt};
    for (const SimdTarget target : simdTargets()) all.emplace_back(target);
    return all;
}

// The light turned with the eye: half a turn about y.
MediumLook lookUnder(const glm::dvec3& direction, int side, MediumModel model) {
    MediumLook look;
    look.model = model;
    look.light = sun({side * direction.x, direction.y, side * direction.z}, 0.5f);
    look.specular = 0.4f;
    return look;
}

// What is seen, and how much two pictures differ at most, the second one mirrored or not.
struct SidesApart {
    float brightest = 0, worst = 0;
};
SidesApart apart(const Plane<glm::vec4>& one, const Plane<glm::vec4>& other) {
    SidesApart all;
    for (int y = 0; y < kSidesPicture; ++y)
        for (int x = 0; x < kSidesPicture; ++x)
            for (int k = 0; k < 4; ++k) {
                if (k < 3) all.brightest = std::max(all.brightest, one.at(x, y)[k]);
                const float d = std::abs(one.at(x, y)[k] - other.at(x, y)[k]);
                all.worst = d <= all.worst ? all.worst : d;  // NaN is kept
            }
    return all;
}

// Which way the gradient points depends on the data: both ways it is one surface.
TEST(MediumOfTwoSides, SurfacesAreLitAlikeWhicheverWayTheirValuesFall) {
    const Medium falls = lensOf(true, 1), grows = lensOf(false, 1);
    for (const glm::dvec3& direction : {glm::dvec3(0.3, 0.2, -1), glm::dvec3(-0.5, 0.4, 1)})
        for (const int side : {-1, 1})
            for (const auto& target : waysToSweep()) {
                SCOPED_TRACE(testing::Message() << direction.z << " from " << side << " "
                                                << (target ? nameOf(*target) : "plain"));
                const MediumLook look = lookUnder(direction, 1, MediumModel::Surface);
                const SidesApart ways = apart(lightSeen(falls, lensView(side), look, target),
                                              lightSeen(grows, lensView(side), look, target));
                EXPECT_GT(ways.brightest, 0.02f);
                EXPECT_LE(ways.worst, 3e-3f);
            }
}

}  // namespace
}  // namespace stereonav
