// Expected errors of warped pixels: what counts as contrast, and that the bound made of a few frames holds on
// others; and what refining makes of them.
#include "engine/stereo/error_prediction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/progress.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/support/calibrate_error.h"
#include "tests/support/own_cache.h"

namespace stereonav {
namespace plain {
void contrastRow(const ContrastRow&);
}
namespace {

// Returns the contrast by its definition, one pixel at a time.
int contrastOf(const Plane<std::uint32_t>& color, const Plane<std::uint8_t>& holes, int x, int y) {
    int largest = 0;
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const int i = std::clamp(x + dx, 0, color.width() - 1), j = std::clamp(y + dy, 0, color.height() - 1);
        if (holes.at(i, j)) continue;
        for (const int shift : {0, 10, 20})
            largest = std::max(largest, std::abs(static_cast<int>(color.at(x, y) >> shift & 1023u) -
                                                 static_cast<int>(color.at(i, j) >> shift & 1023u)));
    }
    return largest;
}

int classOfContrast(int contrast) {
    if (contrast == 0) return 0;
    const int octave = static_cast<int>(std::floor(std::log2(contrast)));
    return 1 + 4 * octave + static_cast<int>(4 * (contrast / std::exp2(octave) - 1));
}

TEST(ErrorPrediction, ClassesAreQuartersOfOctavesOfTheLargestDifference) {
    std::mt19937 random(7);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {37, 23}, {64, 17}}) {
        Plane<std::uint32_t> color(width, height);
        Plane<std::uint8_t> holes(width, height), classes;
        long long known = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const unsigned spread = 1u + random() % 1024;
                color.at(x, y) = random() % spread | random() % spread << 10 | random() % spread << 20;
                holes.at(x, y) = random() % 5 == 0 ? 255 : 0;
                known += holes.at(x, y) == 0;
            }
        const ContrastCounts counts = findContrast(color, holes, classes);
        long long counted = 0;
        for (const long long n : counts) counted += n;
        EXPECT_EQ(counted, known);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                ASSERT_EQ(classes.at(x, y),
                          holes.at(x, y) ? kNoContrast : classOfContrast(contrastOf(color, holes, x, y)))
                    << width << "x" << height << " " << x << " " << y;
    }
    EXPECT_EQ(classOfContrast(1023), kContrastClasses - 1);
}

TEST(ErrorPrediction, EveryInstructionSetGivesTheSameClasses) {
    std::mt19937 random(8);
    std::vector<std::uint32_t> rows(3 * 101);
    std::vector<std::uint8_t> holes(3 * 101), wanted(101), found(101);
    for (auto& c : rows) c = random() & 0x3fffffffu;
    for (auto& h : holes) h = random() % 4 == 0 ? 255 : 0;
    ContrastRow row{&rows[0],    &rows[101],  &rows[202],    &holes[0],
                    &holes[101], &holes[202], wanted.data(), 101};
    plain::contrastRow(row);
    row.classes = found.data();
    fastestContrast()(row);
    EXPECT_EQ(found, wanted);
}

class Refined : public testing::Test {
protected:
    static void SetUpTestSuite() {
        SceneFile file;
        file.builtIn = true;
        file.builtInSize = 257;
        Progress progress;
        sScene = new TerrainScene(loadTerrain(file, progress));
        sRenderer = new TerrainRenderer(*sScene);
        sCalibration = std::make_shared<ErrorCalibration>(calibrateError(*sRenderer, viewsAt(1), {}));
    }
    static void TearDownTestSuite() {
        sCalibration.reset();
        delete sRenderer;
        delete sScene;
    }

    // Every third of 48 poses of the scene's flight, from `first` on.
    static std::vector<StereoViews> viewsAt(std::size_t first) {
        Lens lens = sScene->lens;
        lens.width = 200;
        lens.height = 160;
        StereoSetting stereo = sScene->stereo;
        stereo.separation = stereo.zeroParallax / 30;
        std::vector<StereoViews> views;
        const std::vector<Pose> poses = sScene->path.frames(48);
        for (std::size_t n = first; n < poses.size(); n += 3)
            views.push_back(makeStereoViews(poses[n], lens, stereo));
        return views;
    }

    struct Outcome {
        double psnr_db;
        RightEyeTimings timings;
        EyeImage right, full;
    };
    static Outcome run(const StereoViews& views, const Refinement& refinement) {
        Outcome o;
        EyeImage left;
        for (EyeImage* image : {&left, &o.full})
            image->resize(views.left.width, views.left.height, sRenderer->viewDependence());
        renderEye(*sRenderer, views.left, left);
        renderEye(*sRenderer, views.right, o.full);
        RightEye eye;
        WarpSetting setting;
        setting.refinement = refinement;
        o.timings = eye.render(*sRenderer, views, left, setting, o.right);
        double sum = 0;
        const auto& bytes = srgbByteFromPacked();
        for (int y = 0; y < o.full.height(); ++y)
            for (int x = 0; x < o.full.width(); ++x)
                for (const int shift : {0, 10, 20}) {
                    const double d = 1.0 * bytes[o.full.color.at(x, y) >> shift & 1023u] -
                                     bytes[o.right.color.at(x, y) >> shift & 1023u];
                    sum += d * d;
                }
        const double mean = sum / (3.0 * o.full.width() * o.full.height());
        o.psnr_db = mean > 0 ? 10 * std::log10(255 * 255 / mean) : kMostPsnr_db;
        return o;
    }
    static Refinement wanted(double quality, double psnr_db = 0, double mostPixels = 1) {
        return {sCalibration, quality, psnr_db, mostPixels};
    }

    inline static TerrainScene* sScene = nullptr;
    inline static TerrainRenderer* sRenderer = nullptr;
    inline static std::shared_ptr<ErrorCalibration> sCalibration;
};

// Frames that the calibration has not seen, at several qualities: 95 of 100 are better than their bound.
TEST_F(Refined, TheBoundHoldsOnOtherFrames) {
    int within = 0, all = 0;
    for (const std::size_t first : {std::size_t{0}, std::size_t{2}})
        for (const StereoViews& views : viewsAt(first))
            for (const double quality : {0.0, 0.5, 0.9}) {
                const Outcome o = run(views, wanted(quality));
                ++all;
                within += o.psnr_db >= o.timings.boundPsnr_db;
                EXPECT_GT(o.timings.boundPsnr_db, 20);
            }
    EXPECT_GE(within, 0.95 * all) << within << " of " << all;
}

TEST_F(Refined, ATargetIsReached) {
    int reached = 0, all = 0;
    for (const StereoViews& views : viewsAt(2))
        for (const double target : {45.0, 55.0}) {
            const Outcome o = run(views, wanted(0, target));
            ++all;
            reached += o.psnr_db >= target;
            EXPECT_GE(o.timings.boundPsnr_db, target);
        }
    EXPECT_GE(reached, 0.95 * all) << reached << " of " << all;
}

TEST_F(Refined, MoreQualityIsLessErrorAndMoreRays) {
    const StereoViews views = viewsAt(0)[5];
    double psnr = 0, bound = 0;
    long long refined = -1;
    for (const double quality : {0.0, 0.4, 0.7, 0.9, 0.99}) {
        const Outcome o = run(views, wanted(quality));
        EXPECT_GE(o.psnr_db, psnr) << quality;
        EXPECT_GE(o.timings.boundPsnr_db, bound - 1e-9) << quality;
        EXPECT_GT(o.timings.refinedPixels, refined) << quality;
        psnr = o.psnr_db;
        bound = o.timings.boundPsnr_db;
        refined = o.timings.refinedPixels;
    }
    const Outcome all = run(views, wanted(1));
    EXPECT_EQ(all.psnr_db, kMostPsnr_db);
    EXPECT_EQ(all.timings.holePixels, 200 * 160);
}

TEST_F(Refined, NoMoreThanTheBudgetIsCast) {
    const StereoViews views = viewsAt(0)[5];
    for (const double most : {0.0, 0.01, 0.1}) {
        const Outcome o = run(views, wanted(0.95, 80, most));
        EXPECT_LE(o.timings.refinedPixels, most * 200 * 160);
        if (most == 0.1) {
            EXPECT_GT(o.timings.refinedPixels, 0);
        }
    }
}

TEST_F(Refined, WithoutACalibrationNothingChanges) {
    const StereoViews views = viewsAt(0)[5];
    const Outcome o = run(views, {nullptr, 0.9, 80, 1});
    EXPECT_EQ(o.timings.refinedPixels, 0);
    EXPECT_EQ(o.timings.boundPsnr_db, 0);
    EXPECT_EQ(run(views, wanted(0)).psnr_db, o.psnr_db);
}

TEST_F(Refined, DoesNotDependOnTheThreadCount) {
    const StereoViews views = viewsAt(0)[5];
    const int threads = threadCount();
    setThreadCount(1);
    const Outcome one = run(views, wanted(0.7));
    setThreadCount(3);
    const Outcome three = run(views, wanted(0.7));
    setThreadCount(threads);
    for (int y = 0; y < one.right.height(); ++y)
        for (int x = 0; x < one.right.width(); ++x)
            ASSERT_EQ(one.right.color.at(x, y), three.right.color.at(x, y)) << x << " " << y;
}

TEST(ErrorPrediction, NothingIsConcludedFromNoFrame) {
    EXPECT_THROW(ErrorCalibrator().result(), Error);
}

// Two frames alike but for the error's size: the second is twice what both together expect of it, at most.
TEST(ErrorPrediction, TheMarginCoversWhatWasSeen) {
    ErrorCalibrator calibrator;
    Plane<std::uint8_t> holes(16, 16);
    for (const std::uint32_t apart : {4u, 12u}) {
        EyeImage warped, full;
        for (EyeImage* image : {&warped, &full}) image->resize(16, 16);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                warped.color.at(x, y) = x % 2 ? 500 : 540;
                full.color.at(x, y) = warped.color.at(x, y) + apart;
            }
        calibrator.add(warped, holes, full);
    }
    const ErrorCalibration known = calibrator.result();
    ContrastCounts counts{};
    counts[classOfContrast(40)] = 256;
    const double expected = known.expectedMeanSquare(counts, 256);
    EXPECT_GT(expected, 0);
    EXPECT_GE(known.margin[kContrastClasses], 1.5);
    EXPECT_EQ(known.expectedMeanSquare(counts, 256, classOfContrast(40)), 0);
    EXPECT_EQ(known.boundPsnr_db(counts, 256, 0), kMostPsnr_db);
    for (int c = 1; c < kContrastClasses; ++c) EXPECT_GE(known.meanSquare[c], known.meanSquare[c - 1]);
}

}  // namespace
}  // namespace stereonav
