// The sky over baked transfer: what was seen last is lit before a frame, the rest after frames; in the end
// every texel is as if all had been lit at once.
#include "engine/light/transfer/turning_sky.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/camera/pose.h"
#include "engine/camera/stereo_rig.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/light/transfer/light_beyond.h"

namespace stereonav {
namespace {

constexpr int kOrder = 3;

// A wall of 16^2 bricks, 8 texels thick, every number of its transfer another one.
TransferVolume wall() {
    VolumeFrame frame;
    frame.size = {128, 8, 128};
    frame.spacing = glm::dvec3(0.01);
    std::vector<TexelBrick> bricks(256);
    for (std::uint32_t n = 0; n < bricks.size(); ++n) {
        bricks[n].number = n;
        bricks[n].wanted.fill(n % 3 ? ~0ull : 0x0f0f);
    }
    TransferVolume transfer(frame, kOrder, 1, bricks);
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        std::vector<float> numbers(512 * static_cast<std::size_t>(transfer.numbersPerTexel()));
        for (std::size_t k = 0; k < numbers.size(); ++k)
            // The mean of the sky counts most: nothing is below 0.
            numbers[k] = static_cast<float>(std::sin(0.37 * static_cast<double>(k) + 2.1 * n) +
                                            (k % (kOrder * kOrder) == 0 ? 8 : 0));
        transfer.setBrick(n, numbers);
    }
    return transfer;
}

std::vector<glm::vec3> harmonicsOf(const glm::dvec3& direction) {
    double values[kOrder * kOrder];
    evaluateHarmonics(direction, kOrder, values);
    std::vector<glm::vec3> sky;
    for (const double v : values) sky.emplace_back(v, 2 * v, 3 * v);
    return sky;
}

// Looks at a place of the wall from close by: some bricks fill the picture.
struct Frame {
    explicit Frame(const glm::dvec3& place) {
        Lens lens;
        lens.width = lens.height = 64;
        lens.verticalFov = 0.8;
        view = makeEyeView(poseFromAngles(place - glm::dvec3(0, 0.2, 0), 0, 0, 0), lens);
        image.resize(64, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) image.viewDepth.at(x, y) = 0.2f;
    }
    EyeView view;
    EyeImage image;
};

bool sameLight(const IlluminationVolume& a, const IlluminationVolume& b) {
    for (std::size_t n = 0; n < a.layout.count(); ++n)
        if (a.texels[n] != b.texels[n]) return false;
    return true;
}

struct SkySubject {
    TransferVolume transfer = wall();  // to compare with
    std::vector<glm::vec3> straight = harmonicsOf(glm::normalize(glm::dvec3(0.3, -0.5, 0.7)));
    std::shared_ptr<IlluminationVolume> light = std::make_shared<IlluminationVolume>(transfer.frame());
    TurningSky sky;
    SkySubject() : sky(wall(), straight, light, {}) { transfer.relightAll(straight, *light); }

    IlluminationVolume all(const SkyTurn& turn) const {
        IlluminationVolume whole(transfer.frame());
        transfer.relightAll(turnedSky(straight, turn), whole);
        return whole;
    }
};

// What lies beyond the texels that are known follows them, once all of them are lit.
TEST(TurningSky, LightBeyondTurnsToo) {
    const SkySubject by;
    auto beyond = std::make_shared<IlluminationVolume>(lightBeyond(*by.light));
    const IlluminationVolume before = lightBeyond(*by.light);
    TurningSky sky(wall(), by.straight, by.light, {}, beyond);
    const SkyTurn turn{1.1, 0.3};
    sky.turnTo(turn);
    EyeImage nothing;
    for (int n = 0; n < 50; ++n) sky.seen(EyeView(), nothing);
    const IlluminationVolume wanted = lightBeyond(by.all(turn));
    int moved = 0;
    ASSERT_EQ(beyond->layout.count(), wanted.layout.count());
    for (std::size_t n = 0; n < wanted.layout.count(); ++n) {
        ASSERT_EQ(beyond->texels[n], wanted.texels[n]) << n;
        moved += wanted.texels[n] != before.texels[n];
    }
    EXPECT_GT(moved, 0);
    const std::uint64_t changes = sky.changes();
    sky.seen(EyeView(), nothing);
    EXPECT_EQ(sky.changes(), changes) << "and then it rests";
}

TEST(TurningSky, TurnsAsItSays) {
    constexpr double kQuarter = std::numbers::pi / 2;
    const struct {
        SkyTurn turn;
        glm::dvec3 from, to;
    } cases[] = {{{kQuarter, 0}, {1, 0, 0}, {0, 1, 0}},  // east comes from the north
                 {{0, kQuarter}, {0, 1, 0}, {0, 0, 1}},  // what lies north rises to the zenith
                 {{kQuarter, kQuarter}, {0, 0, 1}, {1, 0, 0}},
                 {{0.3, -0.2}, {1, 0, 0}, {std::cos(0.3), std::sin(0.3), 0}}};
    for (const auto& c : cases) {
        const std::vector<glm::vec3> got = turnedSky(harmonicsOf(c.from), c.turn), want = harmonicsOf(c.to);
        ASSERT_EQ(got.size(), want.size());
        for (std::size_t n = 0; n < got.size(); ++n)
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[n][k], want[n][k], 1e-5) << n;
    }
    EXPECT_ANY_THROW(turnedSky(std::vector<glm::vec3>(5), {}));
    EXPECT_ANY_THROW(turnedSky({}, {}));
}

TEST(TurningSky, WhatIsSeenIsLitBeforeTheFrame) {
    SkySubject s;
    const Frame here({0.6, 0.04, 0.6});
    s.sky.seen(here.view, here.image);
    EXPECT_EQ(s.sky.changes(), 0u) << "nothing has turned";
    const SkyTurn turn{0.7, 0.2};
    s.sky.turnTo(turn);
    const IlluminationVolume whole = s.all(turn), before = s.all({});
    const std::size_t middle = s.light->layout.index(60, 4, 60), corner = s.light->layout.index(98, 1, 120);
    ASSERT_NE(whole.texels[middle], before.texels[middle]);
    ASSERT_NE(whole.texels[corner], before.texels[corner]);
    EXPECT_EQ(s.light->texels[middle], whole.texels[middle]) << "at once";
    EXPECT_EQ(s.light->texels[corner], before.texels[corner]) << "out of view";
    s.sky.seen(here.view, here.image);
    EXPECT_EQ(s.sky.changes(), 1u) << "the rest came after it";
    EXPECT_TRUE(sameLight(*s.light, whole));
    s.sky.seen(here.view, here.image);
    s.sky.turnTo(turn);
    EXPECT_EQ(s.sky.changes(), 1u) << "nothing is left";
}

TEST(TurningSky, TurnedAgainAndAgainIsAsTurnedOnce) {
    SkySubject s;
    for (int n = 0; n <= 20; ++n) {
        const SkyTurn turn{0.3 * n, 0.05 * n};
        s.sky.turnTo(turn);
        const Frame moved({0.1 + 0.05 * n, 0.04, 0.2 + 0.04 * n});
        s.sky.seen(moved.view, moved.image);
        EXPECT_TRUE(sameLight(*s.light, s.all(turn))) << n;
    }
    EXPECT_EQ(s.sky.turn(), (SkyTurn{6.0, 1.0}));
}

}  // namespace
}  // namespace stereonav
