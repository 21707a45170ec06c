// Slices moved by a share of a slab, and swept with more or less work than the scene asks for.
#include <gtest/gtest.h>

#include <vector>

#include "engine/base/error.h"
#include "engine/medium/sweep/swept_frames.h"
#include "tests/medium/sweep_scenes.h"

namespace stereonav {
namespace {

SweepGeometry turnedGeometry(const Medium& medium, double turn, bool inside) {
    MediumLook look;
    look.light = test::sun({0, 0.3, -1});
    SweepSetting setting;
    setting.slices = 40;
    setting.turn = turn;
    const EyeView eye[] = {test::viewFrom({0, 0, inside ? 0.2 : 30.0}, {0, 0, -1}, 0.3, 8, 8)};
    return makeSweepGeometry(medium, look, setting, eye, eye[0].eye);
}

TEST(SweepTurn, MovesEveryFaceButTheEnds) {
    const Medium medium = test::slabOf({{}}, 4);
    for (const bool inside : {false, true})
        for (const double turn : {0.25, 0.618, 0.99}) {
            SCOPED_TRACE(testing::Message() << inside << " " << turn);
            const SweepGeometry still = turnedGeometry(medium, 0, inside),
                                turned = turnedGeometry(medium, turn, inside);
            ASSERT_GT(still.slabs(), 10);
            EXPECT_NEAR(turned.faces.front(), still.faces.front(), 1e-9);
            EXPECT_NEAR(turned.faces.back(), still.faces.back(), 1e-9);
            EXPECT_GE(turned.slabs(), still.slabs());
            EXPECT_LE(turned.slabs(), still.slabs() + 2);
            for (std::size_t k = 1; k < turned.faces.size(); ++k)
                EXPECT_GT(turned.faces[k], turned.faces[k - 1]) << "ascending";
            if (inside) continue;
            const double slab = still.faces[11] - still.faces[10];
            for (std::size_t k = 1; k + 1 < still.faces.size(); ++k)
                EXPECT_NEAR(turned.faces[k], still.faces[k] - turn * slab, 1e-6 * slab);
        }
    EXPECT_THROW(turnedGeometry(medium, 1, false), Error);
    EXPECT_THROW(turnedGeometry(medium, -0.1, false), Error);
}

// The thick slab of one material looks the same however its slices lie; more work comes nearer to the finest.
TEST(SweepTurn, FramesShowTheSameMediumWithAnyTurnAndEffort) {
    MediumScene scene{test::slabOf({{0.5}, {0.1}}, 4), {}, {}, {}, {}, "", "", "", {}, {}};
    scene.look.light = test::sun({0, 0.3, -1});
    scene.sweep.slices = 32;
    scene.sweep.lightSize = 32;
    SweptFrames frames(scene);
    const EyeView view = test::viewFrom({0, 0, 30}, {0, 0, 0}, 0.3, 24, 24);
    const auto greenAt = [&](double effort, double turn) {
        EyePair pair;
        frames.setEffort(effort);
        frames.setTurn(turn);
        frames.makeOne(view, 0, pair);
        return static_cast<double>(unpackColor(pair.left.color.at(12, 12)).y);
    };
    const double finest = greenAt(32, 0), usual = greenAt(1, 0);
    EXPECT_GT(finest, 0.05);
    EXPECT_NEAR(greenAt(1, 0.5), usual, 0.03 * finest);
    EXPECT_LE(std::abs(greenAt(4, 0) - finest), std::abs(greenAt(0.5, 0) - finest) + 1e-3);
    EXPECT_NEAR(greenAt(4, 0), finest, 0.02 * finest);
    EXPECT_EQ(greenAt(1, 0), usual);
}

}  // namespace
}  // namespace stereonav
