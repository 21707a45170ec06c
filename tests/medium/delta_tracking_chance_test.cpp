// The numbers that choose paths through a medium: every pixel, sample and seed has its own. Every ray of
// these pictures is the same, so that pixels are alike where their numbers are.
#include <gtest/gtest.h>

#include "engine/medium/paths/delta_tracking_flight.h"
#include "tests/medium/delta_tracking_scenes.h"
#include "tests/support/chance.h"

namespace stereonav {
namespace {

// A lamp whose light falls with the distance: what a path brings depends on each of its places. Several
// scatters a path, of coloured light.
TrackedPicture chanceOf(int width, int height, int samples, std::uint32_t seed = 1) {
    static const Medium medium = homogeneousSlab(20, 1, {0.95f, 0.9f, 0.8f}, {0.01f, 0.01f, 0.01f});
    MediumLook look = litLook({0, 0, -1}, MediumModel::Indirect);
    look.light.kind = MediumLight::Kind::Lamp;
    look.light.position = {0.02, 0.01, 0.05};
    look.light.falloff = 0.1;
    look.phase = PhaseFunction::henyeyGreenstein({0.3f, 0.2f, 0.1f});
    EyeView view = narrowView({0, 0, -1});
    view.xMin = view.xMax = view.yMin = view.yMax = 0;
    view.width = width, view.height = height;
    TrackingSetting setting;
    setting.samples = samples;
    setting.seed = seed;
    return trackPicture(medium, look, view, setting);
}

test::ChanceField trackedLight(const TrackedPicture& picture) {
    test::ChanceField field(picture.light.width(), picture.light.height());
    for (int y = 0; y < field.height; ++y)
        for (int x = 0; x < field.width; ++x) field.at(x, y) = test::chanceValue(picture.light.at(x, y));
    return field;
}

constexpr int kManySamples = 16;  // some of them bring light, so that no pixel is black

TEST(DeltaTrackingChance, EveryPixelHasNumbersOfItsOwn) {
    test::expectUnrelated(trackedLight(chanceOf(67, 23, kManySamples)));
    test::expectUnrelated(trackedLight(chanceOf(23, 67, kManySamples)));
    test::expectUnrelated(trackedLight(chanceOf(40, 40, kManySamples)));
}

TEST(DeltaTrackingChance, EverySeedHasNumbersOfItsOwn) {
    const test::ChanceField one = trackedLight(chanceOf(67, 23, kManySamples, 1));
    for (const std::uint32_t seed : {0u, 2u, 3u, 1u << 31 | 1u})
        test::expectUnrelated(one, trackedLight(chanceOf(67, 23, kManySamples, seed)));
}

// Pixels vary as their own samples say: so these are independent, and so are those of a larger picture.
TEST(DeltaTrackingChance, EverySampleHasNumbersOfItsOwn) {
    for (const int samples : {2, 16, 64}) {
        const TrackedPicture picture = chanceOf(61, 59, samples);
        double stated = 0;
        const test::ChanceField field = trackedLight(picture);
        for (int y = 0; y < field.height; ++y)
            for (int x = 0; x < field.width; ++x)
                stated += static_cast<double>(picture.variance.at(x, y).x) /
                          static_cast<double>(field.values.size());
        EXPECT_NEAR(test::spreadOfAll(field.first()) / stated, 1, 0.15) << samples;
    }
}

// The numbers themselves: two of each path, over a whole picture.
TEST(DeltaTrackingChance, NoTwoPathsBeginAlike) {
    std::vector<std::array<double, 2>> numbers;
    for (const std::uint64_t seed : {0u, 1u, 2u, 77u})
        for (std::uint64_t pixel = 0; pixel < 4000; ++pixel)
            for (std::uint64_t sample = 0; sample < 8; ++sample) {
                PathRandom random(pixel, sample, seed);
                numbers.push_back({random.uniform(), random.uniform()});
            }
    EXPECT_EQ(test::placesAlike(numbers), "");
    // No stream goes on as another: the second number of one is the first of none.
    std::vector<std::array<double, 1>> all;
    for (const auto& pair : numbers) {
        all.push_back({pair[0]});
        all.push_back({pair[1]});
    }
    EXPECT_EQ(test::placesAlike(all), "");
}

}  // namespace
}  // namespace stereonav
