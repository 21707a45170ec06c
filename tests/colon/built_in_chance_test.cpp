// The scanner's noise in the built-in colon's CT: every voxel has noise of its own. Tested in the air around
// the body, where nothing else differs from voxel to voxel.
#include <gtest/gtest.h>

#include "colon/built_in/built_in_colon.h"
#include "tests/support/chance.h"

namespace stereonav::test {
namespace {

// Rows of voxels 20 mm or more in front of the body's skin or behind it.
constexpr std::array kAirRows{0, 1, 2, 45, 46, 47};
constexpr glm::ivec3 kNoisySize(64, 48, 40);

GreyVolume noisyColon(std::uint64_t seed) {
    Progress quiet;
    BuiltInColonSetting setting;
    setting.seed = seed;
    setting.size = kNoisySize;
    return std::move(builtInColon(setting, quiet).grey);
}

// Values of eight neighbouring voxels: so many that no two runs are equal by chance.
using NoiseRun = std::array<double, 8>;

void addRuns(const GreyVolume& grey, const glm::ivec3& step, std::vector<NoiseRun>& runs) {
    const glm::ivec3 end = kNoisySize - 7 * step;
    for (int k = 0; k < end.z; ++k)
        for (const int j : kAirRows)
            for (int i = 0; i < end.x; ++i) {
                NoiseRun run;
                for (int n = 0; n < 8; ++n)
                    run[static_cast<std::size_t>(n)] = grey.at(glm::ivec3(i, j, k) + n * step);
                runs.push_back(run);
            }
}

TEST(BuiltInColonChance, EveryVoxelHasNoiseOfItsOwn) {
    const GreyVolume grey = noisyColon(1);
    std::vector<NoiseRun> runs;
    addRuns(grey, {1, 0, 0}, runs);
    addRuns(grey, {0, 0, 1}, runs);
    EXPECT_EQ(placesAlike(runs), "");
    for (const int j : kAirRows) {
        ChanceField slice(kNoisySize.x, kNoisySize.z);
        for (int k = 0; k < kNoisySize.z; ++k)
            for (int i = 0; i < kNoisySize.x; ++i) {
                ASSERT_LT(grey.at(i, j, k), -900) << "no air at " << i << " " << j << " " << k;
                slice.at(i, k)[0] = grey.at(i, j, k);
            }
        expectUncorrelated(slice);
        EXPECT_NEAR(std::sqrt(spreadOfAll(slice.first())), 15, 1.5);
    }
}

TEST(BuiltInColonChance, EverySeedHasNoiseOfItsOwn) {
    std::vector<NoiseRun> runs;
    for (const std::uint64_t seed : {1ull, 2ull, 3ull, 1ull << 40})
        addRuns(noisyColon(seed), {1, 0, 0}, runs);
    EXPECT_EQ(placesAlike(runs), "");
}

}  // namespace
}  // namespace stereonav::test
