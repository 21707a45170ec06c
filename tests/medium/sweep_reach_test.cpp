// Light that no eye reads any more stays where it is: what eyes read is never left out, pictures do not
// change by a bit, and what is remembered is bounded.
#include "engine/medium/sweep/sweep_reach.h"

#include <glm/gtc/constants.hpp>
#include <random>

#include "sweep_subjects.h"

namespace stereonav {
namespace {

using test::ball;
using test::Slab;
using test::sun;
using test::viewFrom;

constexpr int kChunk = 8, kTile = 16;

struct ReachCase {
    const char* name;
    glm::dvec3 eye, target, light;
    double half;  // tangent of half the view
    bool lamp;
};
const ReachCase kCases[] = {
    {"whole", {0.5, -3, 0.7}, {0, 0, 0}, {0.6, 0.3, -0.8}, 0.4, false},
    {"narrow", {0.5, -3, 0.7}, {0.2, 0, 0.1}, {0.6, 0.8, -0.3}, 0.06, false},
    {"against", {0.5, -3, 0.7}, {0.2, 0, 0.1}, {0.3, -0.9, -0.3}, 0.06, false},
    {"across", {0.5, -3, 0.7}, {0, 0, 0.3}, {0.9, 0.2, -0.3}, 0.1, false},
    {"inside", {0.1, -0.3, 0.2}, {0.5, 0.5, 0}, {0.2, 0.8, -0.4}, 0.5, false},
    {"inside, against", {0.1, -0.3, 0.2}, {0.5, 0.5, 0}, {-0.2, -0.8, -0.4}, 0.5, false},
    {"lamp", {0.5, -3, 0.7}, {0.2, 0, 0.1}, {0.5, 0.8, -0.3}, 0.1, true},
    {"lamp inside", {0.5, -3, 0.7}, {0.2, 0, 0.1}, {0.9, -0.5, -0.3}, 0.2, true},
};

Slab sceneOf(const ReachCase& c, MediumModel model, int slices) {
    Slab s = ball(model, slices);
    s.look.light = sun(c.light);
    if (c.lamp) {
        s.look.light.kind = MediumLight::Kind::Lamp;
        s.look.light.position = (c.name == std::string("lamp") ? -2.5 : -0.2) * s.look.light.direction;
        s.look.light.coneAngle = 1.0;
    }
    s.setting.lightSize = 144;
    s.setting.coneAngle = 0.3;
    s.setting.blurLength = 0.02;
    EyeView eyes[] = {viewFrom(c.eye, c.target, c.half, 40, 36), viewFrom(c.eye, c.target, c.half, 40, 36)};
    eyes[1].eye += 0.05 * eyes[1].right;
    s.geometry = makeSweepGeometry(s.medium, s.look, s.setting, eyes, c.eye);
    return s;
}

// Places on random rays, in slabs of random chunks: the texels that are read there bilinearly are known.
TEST(SweepReach, holdsWhatRaysRead) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(0, 1);
    for (const ReachCase& c : kCases) {
        const Slab s = sceneOf(c, MediumModel::Indirect, 70);
        const SweepGeometry& g = s.geometry;
        const SweepSpace space(s.medium);
        SweepReach reach;
        reach.start(g, &space, kChunk, kTile, kTile);
        ASSERT_TRUE(reach.known());
        int read = 0;
        for (int n = 0; n < 20000; ++n) {
            const RayFan& eye = g.eyes[n % 2];
            const double x = u(random) * eye.width, y = u(random) * eye.height;
            const int slab = static_cast<int>(u(random) * g.slabs());
            const glm::dvec3 way = eye.direction(x, y);
            const double along = glm::dot(way, g.axis), t = 0.5 * (g.faces[slab] + g.faces[slab + 1]);
            const double far = (t - glm::dot(eye.origin, g.axis)) / along;
            const glm::dvec3 place = eye.origin + far * way;
            if (!(far > 0) || !(s.medium.at(g.anchor + place, 0, 0).extinction > 0)) continue;
            const glm::dvec2 texel = g.light.project(place);
            if (!(texel.x == texel.x)) continue;  // behind a lamp
            for (int corner = 0; corner < 4; ++corner) {
                const int i = std::clamp(static_cast<int>(std::floor(texel.x - 0.5)) + corner % 2, 0,
                                         g.light.width - 1),
                          j = std::clamp(static_cast<int>(std::floor(texel.y - 0.5)) + corner / 2, 0,
                                         g.light.height - 1);
                const int across = (g.light.width + kTile - 1) / kTile;
                EXPECT_GE(reach.lastRead(j / kTile * across + i / kTile), slab) << c.name;
            }
            ++read;
        }
        EXPECT_GT(read, 500) << c.name;
    }
}

TEST(SweepReach, picturesAreTheSameToTheBit) {
    for (const ReachCase& c : kCases)
        for (const MediumModel model : {MediumModel::Direct, MediumModel::Indirect}) {
            const Slab s = sceneOf(c, model, 70);
            MediumSweep sweep(s.medium);
            std::vector<MediumPicture> some(2), all(2);
            const SweepTimings less = sweep.render(s.look, s.setting, s.geometry, 0, some);
            sweep.passAllLight(true);
            const SweepTimings most = sweep.render(s.look, s.setting, s.geometry, 0, all);
            for (int eye = 0; eye < 2; ++eye)
                for (int y = 0; y < 36; ++y)
                    for (int x = 0; x < 40; ++x)
                        ASSERT_EQ(some[eye].light.at(x, y), all[eye].light.at(x, y)) << c.name;
            EXPECT_LE(less.lightTexels, most.lightTexels) << c.name;
            if (c.half < 0.1) {
                const double share = model == MediumModel::Direct ? 0.8 : 1;  // scattered light spreads
                EXPECT_LT(less.lightTexels, share * most.lightTexels) << c.name;
            }
        }
}

// Layers over heights, whose light passes the long way.
TEST(SweepReach, picturesOfLayersAreTheSameToTheBit) {
    std::vector<HeightLayer> layers(1);
    HeightLayer& layer = layers[0];
    layer.levels.emplace_back(41, 41);
    for (int y = 0; y < 41; ++y)
        for (int x = 0; x < 41; ++x)
            layer.levels[0].at(x, y) = static_cast<float>(0.3 * std::sin(0.3 * x) * std::cos(0.2 * y));
    layer.originX = layer.originY = -2;
    layer.spacing = 0.1;
    layer.below = 0.5;
    layer.above = 0.1;
    layer.taper = 0.05;
    makeMipLevels(layer);
    const MediumMaterial material = test::materialOf({6.0, {1.0, 1.5, 2.0}}, 0.2);
    layer.table = makeMediumTable(MediumTransfer({{-1, material}, {1, material}}, 0.2, "test"), layer.lowest,
                                  layer.highest);
    const Medium medium(std::move(layers), {});
    MediumSweep sweep(medium);
    for (const glm::dvec3& light : {glm::dvec3(0.5, 0.6, -0.6), glm::dvec3(-0.2, -0.8, -0.5)}) {
        MediumLook look;
        look.light = sun(light);
        look.model = MediumModel::Indirect;
        SweepSetting setting;
        setting.slices = 70;
        setting.lightSize = 192;
        setting.coneAngle = 0.3;
        setting.blurLength = 0.02;
        const EyeView eye[] = {viewFrom({-1.2, -1.2, 0.9}, {0, 0, 0}, 0.1, 40, 36)};
        std::vector<MediumPicture> some(1), all(1);
        sweep.passAllLight(false);
        const SweepTimings less = sweep.render(look, setting, eye, eye[0].eye, 0, some);
        sweep.passAllLight(true);
        const SweepTimings most = sweep.render(look, setting, eye, eye[0].eye, 0, all);
        EXPECT_LT(less.lightTexels, most.lightTexels);
        for (int y = 0; y < 36; ++y)
            for (int x = 0; x < 40; ++x) ASSERT_EQ(some[0].light.at(x, y), all[0].light.at(x, y));
        EXPECT_GT(all[0].light.at(20, 18).x, 0.01f);
    }
}

// Tiles that read no more let go of all that no other tile reads.
TEST(SweepReach, letsGoOfWhatIsDropped) {
    const Slab s = sceneOf(kCases[0], MediumModel::Indirect, 70);
    SweepReach reach;
    reach.start(s.geometry, nullptr, kChunk, kTile, kTile);
    const int lights = ((s.geometry.light.width + 15) / 16) * ((s.geometry.light.height + 15) / 16);
    const auto reads = [&](int first) {
        int sum = 0;
        for (int n = 0; n < lights; ++n) sum += reach.lastRead(n) >= first;
        return sum;
    };
    reach.begin(0);
    const int before = reads(0);
    EXPECT_GT(before, 0);
    std::vector<int> last;
    for (int n = 0; n < lights; ++n) last.push_back(reach.lastRead(n));
    for (int tile = 0; tile < 9; ++tile) reach.drop(0, tile);
    reach.begin(1);  // the first eye may still sample for the second
    for (int n = 0; n < lights; ++n)
        if (last[n] >= kChunk) {
            EXPECT_EQ(reach.lastRead(n), last[n]);
        }
    for (int tile = 0; tile < 9; ++tile)
        for (int twice = 0; twice < 2; ++twice) reach.drop(1, tile);
    reach.begin(2);
    EXPECT_EQ(reads(2 * kChunk), 0);
}

TEST(SweepReach, remembersNoMoreThanItsLimit) {
    Slab s = ball(MediumModel::Direct, 65536);
    const EyeView eye[] = {viewFrom({0.5, -3, 0.7}, {0, 0, 0}, 0.4, 1920, 1080)};
    s.geometry = makeSweepGeometry(s.medium, s.look, s.setting, eye, eye[0].eye);
    SweepReach reach;
    reach.start(s.geometry, nullptr, kChunk, kTile, kTile);
    EXPECT_FALSE(reach.known());
    EXPECT_LT(reach.heldBytes(), 16u << 20);
}

}  // namespace
}  // namespace stereonav
