// Eyes and surfaces where rays are least comfortable: at the near distance, at grazing angles, in the plane
// of the ground or of a row of pixels, along the grid's axes, 1e7 m from the origin.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "engine/math/constants.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/own_cache.h"
#include "tests/support/stability_row.h"
#include "tests/support/test_grounds.h"
#include "tests/terrain/raster_files.h"

namespace stereonav {
namespace {

using namespace test;

using HeightAt = std::function<double(int i, int j)>;

TerrainScene sceneOf(int width, int height, double spacing, const HeightAt& heightAt) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(static_cast<float>(heightAt(i, j)));
    TerrainScene scene;
    Plane<PackedColor> color(32, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) color.at(x, y) = packColor(glm::vec3(0.1f + 0.02f * float(x)));
    scene.color = ColorTexture(color, {0.0, 0.0}, glm::dvec2(width - 1, height - 1) / 32.0);
    scene.sky = SkyMap(64, gradientSky);
    scene.ground = Heightfield(width, height, {spacing, spacing}, std::move(heights), "test");
    return scene;
}

double plainDepth(const TerrainScene& scene, const EyeView& view, double x, double y) {
    return castPlain(scene.ground, view.eye, view.rayDirection(x, y), view.nearDepth).t;
}

// Pixels, on every instruction set, whose depth differs from the plain walk's by more than a millionth (see
// terrain_extent_rows_test.cpp) and that no ray within a thousandth of a pixel explains.
void countOthers(const TerrainScene& scene, const EyeView& view, StabilityRow& row) {
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = castPicture(TerrainRenderer(scene, target), view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const double got = image.viewDepth.at(x, y);
                const double exact = plainDepth(scene, view, x + 0.5, y + 0.5);
                if (got == exact || std::abs(got / exact - 1) <= 1e-6) continue;
                double least = exact, most = exact;
                for (const glm::dvec2 shift : {glm::dvec2(0, -1), {0, 1}, {-1, 0}, {1, 0}}) {
                    const double depth =
                        plainDepth(scene, view, x + 0.5 + 1e-3 * shift.x, y + 0.5 + 1e-3 * shift.y);
                    least = std::min(least, depth);
                    most = std::max(most, depth);
                }
                row.count(!(got >= least * (1 - 1e-6) && got <= most * (1 + 1e-6)));
            }
    }
}

// ---- the near distance

class NearPlaneRow : public testing::TestWithParam<double> {};

TEST_P(NearPlaneRow, GroundAtTheNearDistance) {
    const double near = 2.5, share = GetParam();
    StabilityRow row("near/ground/" + shortNumber(share),
                     "flat ground straight below at 1 + " + shortNumber(share) + " of the near distance",
                     "pixels that do not show the ground behind the near distance alone", 0, "pixels");
    row.count(0);
    const TerrainScene scene = sceneOf(33, 33, 1, [](int, int) { return 0.0; });
    const Lens lens{31, 23, 0.5, 1.0, near};
    const double depth = near * (1 + share);
    const EyeView view = makeEyeView(poseFromAngles({0.3, 0.2, depth}, 0, -kPi / 2, 0), lens);
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = castPicture(TerrainRenderer(scene, target), view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const float got = image.viewDepth.at(x, y);
                const bool ground = std::abs(got - depth) <= 0x1p-22 * depth;
                // At the near distance itself either is right.
                row.count(share == 0 ? !(ground || std::isinf(got)) : share < 0 ? !std::isinf(got) : !ground);
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, NearPlaneRow, testing::Values(-1e-1, -1e-3, -1e-5, 0.0, 1e-5, 1e-3, 1e-1),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

// ---- grazing

class GrazingRow : public testing::TestWithParam<std::tuple<double, double>> {};

// Rows of pixels a ten-thousandth of a degree apart: the k-th below the horizon meets flat ground at
// height / ((k + 1/2) * pixel).
TEST_P(GrazingRow, FlatGroundIsMetWhereItIs) {
    const auto [above, heading] = GetParam();
    StabilityRow row("grazing/" + shortNumber(above) + "m/" + shortNumber(heading),
                     "flat ground at half to twenty times 1e-4 degrees from " + shortNumber(above) +
                         " m above, heading " + shortNumber(heading) + " degrees",
                     "relative depth error against the closed form", 1e-6, "");
    const double pixel = 1e-4 * kPi / 180, farthest = above / (0.5 * pixel);
    const TerrainScene scene = sceneOf(65, 65, farthest / 31, [](int, int) { return 0.0; });
    Lens lens{5, 40, 0.8, 1.0, 1e-3 * above};
    lens.verticalFov = 2 * std::atan(20 * pixel);
    const EyeView view = makeEyeView(poseFromAngles({0, 0, above}, heading * kPi / 180, 0, 0), lens);
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = castPicture(TerrainRenderer(scene, target), view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const double got = image.viewDepth.at(x, y);
                if (y < 20) {
                    row.saw(std::isinf(got) ? 0 : 1);
                } else {
                    const double truth = above / ((y - 20 + 0.5) * pixel);
                    row.saw(std::abs(got - truth) / truth);
                }
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, GrazingRow,
                         testing::Combine(testing::Values(1e-3, 1.0, 1e3), testing::Values(0.0, 30.0, 135.0)),
                         [](const auto& given) {
                             return testName(shortNumber(std::get<0>(given.param)) + "_" +
                                             shortNumber(std::get<1>(given.param)));
                         });

// ---- edge-on and coplanar with a scanline

struct EdgeCase {
    const char* id;
    const char* words;
    double height, heading, pitch, roll;
    bool plateau;
};

class EdgeOnRow : public testing::TestWithParam<EdgeCase> {};

TEST_P(EdgeOnRow, AgreesWithThePlainWalk) {
    const EdgeCase& c = GetParam();
    StabilityRow row(std::string("edge-on/") + c.id, c.words, "pixels other than the plain walk's", 0,
                     "pixels");
    row.count(0);
    const TerrainScene scene =
        sceneOf(65, 65, 10, [&](int i, int j) { return c.plateau && i > 36 && j > 36 ? 40.0 : 0.0; });
    const Lens lens{41, 31, 0.9, 1.0, 0.1};  // odd: the middle row lies in the horizon
    const Pose pose =
        poseFromAngles({3, 4, c.height}, c.heading * kPi / 180, c.pitch * kPi / 180, c.roll * kPi / 180);
    countOthers(scene, makeEyeView(pose, lens), row);
}

INSTANTIATE_TEST_SUITE_P(
    Stability, EdgeOnRow,
    testing::Values(
        EdgeCase{"ground/0", "the eye in the plane of flat ground, level, north", 0, 0, 0, 0, false},
        EdgeCase{"ground/45", "the eye in the plane of flat ground, level, north-east", 0, 45, 0, 0, false},
        EdgeCase{"ground/rolled", "the eye in the plane of flat ground, rolled by 90 degrees", 0, 20, 0, 90,
                 false},
        EdgeCase{"ground/down", "the eye in the plane of flat ground, looking down", 0, 20, -90, 0, false},
        EdgeCase{"plateau/45", "a plateau at the eye's height: a row of pixels in its plane", 40, 45, 0, 0,
                 true},
        EdgeCase{"plateau/30", "a plateau at the eye's height, heading 30 degrees", 40, 30, 0, 0, true},
        EdgeCase{"plateau/rolled", "a plateau at the eye's height, rolled by 90 degrees", 40, 45, 0, 90,
                 true},
        EdgeCase{"below/45", "the eye a metre below flat ground", -1, 45, 0, 0, false}),
    [](const auto& given) { return testName(given.param.id); });

// ---- exactly along an axis

class AxisRow : public testing::TestWithParam<int> {};

TEST_P(AxisRow, ViewsExactlyAlongAnAxis) {
    constexpr const char* kNames[] = {"east", "north", "west", "south", "down", "up"};
    const glm::dvec3 kForward[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}};
    const int k = GetParam();
    StabilityRow row(std::string("axis/") + kNames[k],
                     std::string("hills seen exactly ") + kNames[k] + ", a column of rays of direction 0",
                     "pixels other than the plain walk's", 0, "pixels");
    row.count(0);
    for (const double spacing : {1.0, 1.5625, 30.0, 0.1, 1e-3, 1e4}) {
        const TerrainScene scene = sceneOf(65, 65, spacing, [&](int i, int j) {
            return spacing * (2 + 2 * std::sin(0.3 * i) * std::cos(0.2 * j));
        });
        EyeView view;
        view.forward = kForward[k];
        view.up = k < 4 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        view.right = glm::cross(view.forward, view.up);
        view.xMin = -0.5, view.xMax = 0.5, view.yMin = -0.4, view.yMax = 0.4;
        view.width = 33, view.height = 27;
        view.nearDepth = 1e-3 * spacing;
        // Between samples, on a line of them, and on a sample.
        for (const glm::dvec2 at : {glm::dvec2(1.3, -2.4), glm::dvec2(3, 0.3), glm::dvec2(-4, 2)}) {
            view.eye = view.head = glm::dvec3(at, k == 5 ? 1.0 : 4.7) * spacing;
            countOthers(scene, view, row);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, AxisRow, testing::Range(0, 6));

// ---- far from the origin

// A strip of 2e7 m whose heights repeat, so that what is seen at its end is what is seen in its middle.
struct FarStrip {
    TerrainScene scene;
    bool north;  // the way it runs
    static constexpr int kPeriod = 100, kLong = 666'701;
    static constexpr double kSpacing = 30;

    explicit FarStrip(bool n)
        : scene(sceneOf(n ? 5 : kLong, n ? kLong : 5, kSpacing,
                        [n](int i, int j) {
                            const double along = (n ? j : i) % kPeriod, across = n ? i : j;
                            return 100 * std::sin(2 * kPi * along / kPeriod) + 5 * across;
                        })),
          north(n) {}

    Pose poseAt(double along, double ahead) const {
        const glm::dvec2 place = north ? glm::dvec2(3, along + ahead) : glm::dvec2(along + ahead, 3);
        return poseFromAngles({place, 40}, north ? 0 : kPi / 2, -0.3, 0);
    }
};

class FarRow : public testing::TestWithParam<bool> {
protected:
    static constexpr double kFar = FarStrip::kSpacing * FarStrip::kPeriod * 3333;  // 9.999e6 m
    const Lens lens{41, 31, 0.5, 1.0, 0.1};
    std::string way() const { return GetParam() ? "north" : "east"; }
};

TEST_P(FarRow, NothingJittersFarFromTheOrigin) {
    const FarStrip strip(GetParam());
    // A step forward shortens depths by what the plain walk says. A depth of up to 200 m is found to 1e-7 of
    // it (kernel_cast.h, refine) and stored to 2^-24, two of them; the eye's place itself is rounded to 2^-53
    // of 1e7 m.
    StabilityRow jitter("far/step/" + way(), "eyes 1e7 m " + way() + " of the origin move by 1e-4 m",
                        "error of the depths' change", 2 * 200 * (1e-7 + 0x1p-24) + 1e-8, "m");
    StabilityRow depths("far/depth/" + way(), "the same ground 1e7 m " + way() + " of the origin and at it",
                        "relative difference of depths, and of the plain walk's", 0x1p-22, "");
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(strip.scene, target);
        const EyeView here = makeEyeView(strip.poseAt(kFar, 0), lens),
                      there = makeEyeView(strip.poseAt(kFar, 1e-4), lens),
                      origin = makeEyeView(strip.poseAt(0, 0), lens);
        const EyeImage a = castPicture(renderer, here), b = castPicture(renderer, there),
                       middle = castPicture(renderer, origin);
        for (int y = 0; y < lens.height; ++y)
            for (int x = 0; x < lens.width; ++x) {
                const double p = plainDepth(strip.scene, here, x + 0.5, y + 0.5),
                             q = plainDepth(strip.scene, there, x + 0.5, y + 0.5);
                const double got = a.viewDepth.at(x, y), at = middle.viewDepth.at(x, y);
                if (std::isinf(p) || std::isinf(q) || p > 200) continue;
                jitter.saw(std::abs((b.viewDepth.at(x, y) - got) - (q - p)));
                depths.saw(std::abs(got - at) / at);
                depths.saw(std::abs(got - p) / p);
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, FarRow, testing::Bool());

// Northings of 1e7 m are the file's; the scene's own coordinates start in its middle.
TEST(FarRows, NorthingsOf1e7AreTakenOff) {
    StabilityRow row("far/northing", "an elevation model at northing 1e7 m and the same at 0",
                     "difference of places and heights", 1e-6, "m");
    const TempFolder folder;
    const auto load = [&](const std::string& name, double northing) {
        RasterSpec spec;
        spec.width = 33, spec.height = 29;
        spec.epsg = 0;
        spec.transform = {500000, 30, 0, northing, 0, -30};
        spec.value = [](int c, int r, int) { return 200 + 50 * std::sin(0.4 * c) * std::cos(0.3 * r); };
        SceneFile file;
        file.file = file.dem = writeRaster(folder / name, spec);
        Progress quiet;
        return loadTerrain(file, quiet);
    };
    const TerrainScene far = load("far.tif", 1e7), near = load("near.tif", 0);
    ASSERT_EQ(far.ground.width(), near.ground.width());
    ASSERT_EQ(far.ground.height(), near.ground.height());
    for (int j = 0; j < far.ground.height(); ++j)
        for (int i = 0; i < far.ground.width(); ++i) {
            row.saw(std::abs(far.ground.sample(i, j) - near.ground.sample(i, j)));
            row.saw(glm::distance(far.ground.worldFromGrid({i, j}), near.ground.worldFromGrid({i, j})));
        }
    row.saw(glm::distance(far.startPose.position, near.startPose.position));
}

}  // namespace
}  // namespace stereonav
