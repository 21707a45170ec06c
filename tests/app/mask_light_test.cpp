// Light of masks in which single voxels stand alone: worked out lazily, from texels, it is that of paths from
// every pixel. Their voxels are surfaces at their own values, and no part of the one that is shown.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

constexpr int kFar = 6;

struct Apart {
    double rms = 0;
    double far = 0;  // the share of pixels that differ by more than kFar levels
    int brighter = 0,
        darker = 0;  // the farthest, in levels of 255: the first picture above and below the second
};

class MaskLight : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    // A block of ones, with a grid of zeros at this depth under each face: 0 are pits in the faces
    // themselves.
    std::string pitted(int depth, int length) const {
        return nrrd("pits.nrrd", {26, 26, length, 1, "uchar", ""}, [depth, length](int i, int j, int k) {
            constexpr int kFirst = 4;
            const int at[3] = {i, j, k}, ends[3] = {21, 21, length - 5};
            for (int axis = 0; axis < 3; ++axis)
                if (at[axis] < kFirst || at[axis] > ends[axis]) return 0;
            for (int face = 0; face < 3; ++face) {
                const int a = at[(face + 1) % 3] - kFirst, b = at[(face + 2) % 3] - kFirst;
                const bool onGrid = std::min(a, b) > 2 && a % 4 == 3 && b % 4 == 3;
                if (onGrid && (at[face] == kFirst + depth || at[face] == ends[face] - depth)) return 0;
            }
            return 1;
        });
    }
    Apart apart(const std::string& scene, std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", scene, "--mode", "ml", "--exposure", "0.5", "--size",
                                         "160x120", "--no-cache"});
        Plane<PackedColor> pictures[2];
        for (const bool traced : {false, true}) {
            std::vector<std::string> all = options;
            all.insert(all.end(),
                       {"--light", traced ? "traced" : "lazy", "--out", traced ? "b.png" : "a.png"});
            if (traced)
                all.insert(all.end(), {"--samples", "256", "--bounces", "1"});
            else
                all.insert(all.end(), {"--edges", "0"});  // paths go through the centres of pixels
            const Outcome outcome = run(all);
            EXPECT_EQ(outcome.status, 0) << outcome.err;
            pictures[traced] = readColorImage(place() / (traced ? "b.png" : "a.png"));
        }
        Apart result;
        const auto& bytes = srgbByteFromPacked();
        for (int y = 0; y < pictures[0].height(); ++y)
            for (int x = 0; x < pictures[0].width(); ++x) {
                const int d =
                    int{bytes[pictures[0].at(x, y) & 1023u]} - int{bytes[pictures[1].at(x, y) & 1023u]};
                result.rms += d * d;
                result.far += std::abs(d) > kFar;
                result.brighter = std::max(result.brighter, d);
                result.darker = std::max(result.darker, -d);
            }
        result.rms = std::sqrt(result.rms / (160.0 * 120.0));
        result.far /= 160.0 * 120.0;
        std::printf("rms %.2f, %.3f %% far, %d brighter, %d darker\n", result.rms, 100 * result.far,
                    result.brighter, result.darker);
        return result;
    }
};

TEST_F(MaskLight, OfPitsInAWallIsThatOfPathsFromEveryPixel) {
    const Apart found = apart(pitted(0, 26), {"--isosurface", "--isovalue", "50", "--fov", "25"});
    EXPECT_LT(found.rms, 1.5);
    EXPECT_LE(found.brighter, 6);
    EXPECT_LE(found.darker, 10);
}

TEST_F(MaskLight, OfHolesBehindAWallIsThatOfPathsFromEveryPixel) {
    // A few pixels where walls meet are brighter: the edge of the lamp's light lies between texels.
    // Without smoothing: smoothed, each hole is a surface of a size that is seen, and smaller than a texel.
    const Apart found = apart(pitted(1, 60), {"--mask-smoothing", "0"});
    EXPECT_LT(found.rms, 1.5);
    EXPECT_LT(found.far, 0.005);
    EXPECT_LE(found.darker, 10);
}

// Shorter than the distance of lights that nobody chose: one light.
TEST_F(MaskLight, OfAShortLumenHasALight) {
    const Outcome outcome =
        run({"render", pitted(1, 26), "--light", "lazy", "--size", "16x12", "--no-cache", "--out", "a.png"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::filesystem::remove(place() / "a.png");
    expectRefused({"bake", pitted(1, 26), "--light", "centreline,0.2", "--samples", "1", "--no-cache",
                   "--out", "a.bake"},
                  {"--light", "shorter than the lights' distance"});
}

}  // namespace
}  // namespace stereonav::test
