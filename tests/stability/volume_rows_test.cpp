// Volumes at the edge of what a grid can say: lumens one voxel wide, walls thinner than a voxel, very long
// voxels, values at the ends of 16 bits, grids 1e7 m from the origin, surfaces at grazing angles and at the
// near distance. The packet casters on every instruction set against the plain walk in double precision.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "engine/math/constants.h"
#include "engine/volume/plain_volume_caster.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

using namespace test;

double plainDepth(const VolumeScene& scene, const EyeView& view, double x, double y) {
    return castPlainVolume(scene.field, scene.cells.isovalue,
                           {view.eye, view.rayDirection(x, y), view.nearDepth})
        .t;
}

struct DepthRange {
    double least = HUGE_VAL, most = 0;
    void add(double depth) {
        least = std::min(least, depth);
        most = std::max(most, depth);
    }
    bool holds(double depth, double share) const {
        return depth >= least * (1 - share) && depth <= most * (1 + share);
    }
};

// Positions in single precision are off by some 2^-24 of the grid's width: 2e-5 of a depth of a voxel and
// more (as the tests of the renderer have it). A ray that passes an edge within a hundredth of a pixel may
// show either side of it.
constexpr double kVolumeDepthBound = 2e-5;

bool isSeen(const VolumeScene& scene, const EyeView& view, int x, int y, double got) {
    DepthRange range;
    range.add(plainDepth(scene, view, x + 0.5, y + 0.5));
    if (got == range.most || range.holds(got, kVolumeDepthBound)) return true;
    for (const double dx : {-0.01, 0.0, 0.01})
        for (const double dy : {-0.01, 0.0, 0.01})
            range.add(plainDepth(scene, view, x + 0.5 + dx, y + 0.5 + dy));
    return range.holds(got, kVolumeDepthBound);
}

long long otherPixels(const VolumeScene& scene, const EyeView& view) {
    long long others = 0;
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = castPicture(VolumeRenderer(scene, {target}), view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                others += !isSeen(scene, view, x, y, image.viewDepth.at(x, y));
    }
    return others;
}

// ---- shapes

struct Shape {
    const char* id;
    const char* words;
    glm::ivec3 size;
    glm::dvec3 spacing;  // metres
    double isovalue;
    std::function<double(const glm::ivec3&)> value;
    glm::dvec3 eye;  // voxels
};

double noiseOf(const glm::ivec3& v) {
    std::mt19937 random(static_cast<unsigned>(v.x + 64 * v.y + 4096 * v.z));
    return random() % 65536 - 32768.0;
}
double ballOf(const glm::dvec3& v, const glm::dvec3& centre, double radius) {
    return std::clamp(-480 + 400 * (glm::length(v - centre) - radius), -1000.0, 40.0);
}

std::vector<Shape> shapes() {
    const glm::dvec3 mm(1e-3);
    const auto line = [](int half) {
        return [half](const glm::ivec3& v) {
            return std::abs(v.x - 8) <= half && std::abs(v.y - 8) <= half ? -1000.0 : 40.0;
        };
    };
    const auto twoTubes = [](double wall) {
        return [wall](const glm::ivec3& v) { return v.x == 8 ? wall : v.x > 1 && v.x < 15 ? -1000.0 : 40.0; };
    };
    const auto tube = [](const glm::dvec3& spacing) {
        return [spacing](const glm::ivec3& v) {
            const glm::dvec3 p = spacing * glm::dvec3(v);
            return std::clamp(-480 + 4e5 * (glm::length(p - glm::dvec3(0.02)) - 0.015), -1000.0, 40.0);
        };
    };
    return {
        {"lumen/1", "a lumen one voxel wide", {17, 17, 40}, mm, -480, line(0), {8, 8, 20}},
        {"lumen/3", "a lumen three voxels wide", {17, 17, 40}, mm, -480, line(1), {8.3, 7.6, 20}},
        {"wall/1", "a wall one voxel thin", {17, 17, 17}, mm, -480, twoTubes(40), {5, 8, 8}},
        {"wall/thin",
         "a wall thinner than a voxel, just above the isovalue",
         {17, 17, 17},
         mm,
         -480,
         twoTubes(-479),
         {5, 8, 8}},
        {"wall/gone",
         "a wall thinner than a voxel, just below the isovalue",
         {17, 17, 17},
         mm,
         -480,
         twoTubes(-481),
         {5, 8, 8}},
        {"wall/equal", "a wall of the isovalue itself", {17, 17, 17}, mm, -480, twoTubes(-480), {5, 8, 8}},
        {"spacing/1:1:20",
         "voxels twenty times as long as wide",
         {41, 41, 3},
         {1e-3, 1e-3, 20e-3},
         -480,
         tube({1e-3, 1e-3, 20e-3}),
         {20, 20, 1}},
        {"spacing/20:1:1",
         "voxels twenty times as wide as long",
         {3, 41, 41},
         {20e-3, 1e-3, 1e-3},
         -480,
         tube({20e-3, 1e-3, 1e-3}),
         {1, 20, 20}},
        {"spacing/1um",
         "voxels of a micrometre",
         {41, 41, 41},
         glm::dvec3(1e-6),
         -480,
         [](const glm::ivec3& v) { return ballOf(v, glm::dvec3(20), 14); },
         {20, 21, 19}},
        {"spacing/1km",
         "voxels of a kilometre",
         {41, 41, 41},
         glm::dvec3(1e3),
         -480,
         [](const glm::ivec3& v) { return ballOf(v, glm::dvec3(20), 14); },
         {20, 21, 19}},
        {"int16/step",
         "a step from one end of 16 bits to the other",
         {17, 17, 17},
         mm,
         0,
         [](const glm::ivec3& v) { return v.z < 9 ? -32768.0 : 32767.0; },
         {8, 8, 3}},
        {"int16/top",
         "the isovalue at the upper end of 16 bits",
         {17, 17, 17},
         mm,
         32767,
         [](const glm::ivec3& v) { return v.z < 9 ? -32768.0 : 32767.0; },
         {8, 8, 3}},
        {"plateau/whole",
         "a plateau of the isovalue, a whole number",
         {17, 17, 17},
         mm,
         100,
         [](const glm::ivec3& v) { return v.z + v.x / 5 < 9 ? -32768.0 : 100.0; },
         {8, 8, 3}},
        {"plateau/near",
         "a plateau a thousandth above the isovalue",
         {17, 17, 17},
         mm,
         99.999,
         [](const glm::ivec3& v) { return v.z + v.x / 5 < 9 ? -32768.0 : 100.0; },
         {8, 8, 3}},
        {"plateau/ball",
         "a ball's hollow in a plateau of the isovalue",
         {17, 17, 17},
         mm,
         40,
         [](const glm::ivec3& v) { return ballOf(v, glm::dvec3(8), 5); },
         {8.2, 7.9, 8.1}},
        {"int16/bottom",
         "the isovalue one above the lower end of 16 bits",
         {17, 17, 17},
         mm,
         -32767,
         [](const glm::ivec3& v) { return v.z < 9 ? -32768.0 : 32767.0; },
         {8, 8, 3}},
        {"int16/noise", "noise over all of 16 bits", {17, 17, 17}, mm, 30000, noiseOf, {8, 8, 8}},
        {"least",
         "a volume of 2 x 2 x 2",
         {2, 2, 2},
         mm,
         0,
         [](const glm::ivec3& v) { return v.z ? 100.0 : -100.0; },
         {0.5, 0.5, 0.2}},
        {"even",
         "a volume without any surface",
         {9, 9, 9},
         mm,
         0,
         [](const glm::ivec3&) { return -5.0; },
         {4, 4, 4}},
        {"long",
         "a volume of 2 x 2 x 5,000",
         {2, 2, 5000},
         mm,
         0,
         [](const glm::ivec3& v) { return v.z > 4990 ? 100.0 : -100.0; },
         {0.5, 0.5, 10}},
    };
}

class ShapeRow : public testing::TestWithParam<int> {};

TEST_P(ShapeRow, IsCastAsByThePlainWalk) {
    const Shape shape = shapes()[static_cast<std::size_t>(GetParam())];
    StabilityRow row(std::string("volume/") + shape.id, shape.words, "pixels other than the plain walk's", 0,
                     "pixels");
    row.count(0);
    GreyVolume field(frameOf(shape.size, shape.spacing));
    for (int k = 0; k < shape.size.z; ++k)
        for (int j = 0; j < shape.size.y; ++j)
            for (int i = 0; i < shape.size.x; ++i)
                field.at(i, j, k) = static_cast<std::int16_t>(std::lround(shape.value({i, j, k})));
    const VolumeScene scene = surfaceScene(std::move(field), shape.isovalue);
    const double least = std::min({shape.spacing.x, shape.spacing.y, shape.spacing.z});
    const Lens lens{23, 19, 1.2, 1.0, 0.05 * least};
    const glm::dvec3 eye = scene.field.frame.worldFromVoxel(shape.eye);
    // Upwards along the third axis, and around.
    row.count(double(otherPixels(scene, makeEyeView(poseFromAngles(eye, 0, kPi / 2, 0), lens))));
    for (int turn = 0; turn < 6; ++turn)
        row.count(double(otherPixels(
            scene, makeEyeView(poseFromAngles(eye, turn * kPi / 3, 0.3 * turn - 0.8, turn), lens))));
}

INSTANTIATE_TEST_SUITE_P(Stability, ShapeRow, testing::Range(0, 20), [](const auto& given) {
    return testName(shapes()[static_cast<std::size_t>(given.param)].id);
});

// ---- far from the origin

VolumeScene ballScene(const glm::dvec3& origin) {
    VolumeFrame frame = frameOf({41, 41, 41}, glm::dvec3(1e-3));
    frame.origin = origin;
    GreyVolume field(frame);
    for (int k = 0; k < 41; ++k)
        for (int j = 0; j < 41; ++j)
            for (int i = 0; i < 41; ++i)
                field.at(i, j, k) = static_cast<std::int16_t>(ballOf({i, j, k}, glm::dvec3(20), 14));
    return surfaceScene(std::move(field), -480);
}

TEST(VolumePlaceRows, FarFromTheOrigin) {
    const glm::dvec3 origin(1e7, -1e7, 1e7);
    const VolumeScene far = ballScene(origin), near = ballScene(glm::dvec3(0));
    const Lens lens{33, 27, 1.2, 1.0, 1e-4};
    // The eye's place is rounded to 2^-53 of 1e7 m, 2e-9 m, each way; a ray across the wall takes it over.
    StabilityRow depths("far/volume", "a lumen 1e7 m from the origin and the same at it",
                        "difference of depths", 4 * 2e-9 + 0.014 * kVolumeDepthBound, "m");
    StabilityRow steps("far/volume/step", "eyes in a lumen 1e7 m from the origin move by 1e-4 m",
                       "error of the depths' change", 2 * (4 * 2e-9 + 0.02 * kVolumeDepthBound), "m");
    for (const SimdTarget target : simdTargets()) {
        const VolumeRenderer there(far, {target}), here(near, {target});
        const auto at = [&](const glm::dvec3& from, double ahead) {
            Pose pose = poseFromAngles(from + glm::dvec3(0.02), 0.4, 0.2, 0.1);
            pose.position += ahead * pose.forward();
            return makeEyeView(pose, lens);
        };
        const EyeImage a = castPicture(here, at(glm::dvec3(0), 0)), b = castPicture(there, at(origin, 0)),
                       c = castPicture(there, at(origin, 1e-4));
        for (int y = 0; y < lens.height; ++y)
            for (int x = 0; x < lens.width; ++x) {
                depths.saw(std::abs(a.viewDepth.at(x, y) - b.viewDepth.at(x, y)));
                const double change = plainDepth(near, at(glm::dvec3(0), 1e-4), x + 0.5, y + 0.5) -
                                      plainDepth(near, at(glm::dvec3(0), 0), x + 0.5, y + 0.5);
                steps.saw(std::abs((c.viewDepth.at(x, y) - b.viewDepth.at(x, y)) - change));
            }
    }
}

// ---- grazing and near surfaces

// A flat wall: value rises by 400 a voxel downwards through the plane z = 8.25 voxels.
VolumeScene flatScene() {
    GreyVolume field(frameOf({65, 65, 17}, glm::dvec3(1e-3)));
    for (int k = 0; k < 17; ++k)
        for (int j = 0; j < 65; ++j)
            for (int i = 0; i < 65; ++i) field.at(i, j, k) = static_cast<std::int16_t>(400 * (8 - k) + 100);
    return surfaceScene(std::move(field), 0);
}

class GrazingVolumeRow : public testing::TestWithParam<double> {};

TEST_P(GrazingVolumeRow, HitsLieOnTheWall) {
    const double degrees = GetParam();
    // Coordinates of up to 64 voxels in single precision, a few of their roundings.
    StabilityRow row("grazing/volume/" + shortNumber(degrees),
                     "a flat wall at about " + shortNumber(degrees) + " degrees, from above it",
                     "distance of hits from the wall", 64 * 8 * 0x1p-24, "voxels");
    row.saw(0);
    const VolumeScene scene = flatScene();
    const double slope = std::tan(degrees * kPi / 180);
    // The middle row of pixels meets the wall 40 voxels on.
    const double above = 8.25e-3 + 0.040 * slope;
    Lens lens{15, 11, 0.8, 1.0, 1e-4};
    lens.verticalFov = std::clamp(4 * slope, 1e-5, 0.8);
    for (const double heading : {0.0, 0.5, 0.785}) {
        const EyeView view =
            makeEyeView(poseFromAngles({0.01, 0.01, above}, heading, -std::atan(slope), 0), lens);
        for (const SimdTarget target : simdTargets()) {
            const EyeImage image = castPicture(VolumeRenderer(scene, {target}), view);
            int hits = 0;
            for (int y = 0; y < lens.height; ++y)
                for (int x = 0; x < lens.width; ++x) {
                    const double depth = image.viewDepth.at(x, y);
                    if (!std::isfinite(depth)) continue;
                    ++hits;
                    row.saw(std::abs(view.pointAt(x + 0.5, y + 0.5, depth).z / 1e-3 - 8.25));
                }
            // Rays at half the angle and less leave the volume first.
            EXPECT_GE(hits, lens.width * lens.height / 3);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, GrazingVolumeRow, testing::Values(1e-4, 1e-2, 1.0, 10.0),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

class EdgeOnVolumeRow : public testing::TestWithParam<double> {};

TEST_P(EdgeOnVolumeRow, EyesInTheWallsPlaneAgreeWithThePlainWalk) {
    const double heading = GetParam();
    StabilityRow row("edge-on/volume/" + shortNumber(heading),
                     "the eye in the plane of a flat wall, heading " + shortNumber(heading) + " degrees",
                     "pixels other than the plain walk's", 0, "pixels");
    row.count(0);
    const VolumeScene scene = flatScene();
    for (const double roll : {0.0, kPi / 2})
        row.count(double(otherPixels(
            scene, makeEyeView(poseFromAngles({0.0323, 0.0317, 8.25e-3}, heading * kPi / 180, 0, roll),
                               {21, 17, 0.8, 1.0, 1e-5}))));
}

INSTANTIATE_TEST_SUITE_P(Stability, EdgeOnVolumeRow, testing::Values(0.0, 30.0, 45.0, 90.0),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

class NearWallRow : public testing::TestWithParam<double> {};

TEST_P(NearWallRow, WallAtTheNearDistance) {
    const double near = 4e-3, share = GetParam();
    StabilityRow row("near/volume/" + shortNumber(share),
                     "a flat wall straight below at 1 + " + shortNumber(share) + " of the near distance",
                     "relative depth error; where the wall is nearer rays begin in it", kVolumeDepthBound,
                     "");
    const VolumeScene scene = flatScene();
    const double depth = near * (1 + share);
    const EyeView view = makeEyeView(poseFromAngles({0.0323, 0.0317, 8.25e-3 + depth}, 0, -kPi / 2, 0),
                                     {15, 11, 0.4, 1.0, near});
    for (const SimdTarget target : simdTargets()) {
        const EyeImage image = castPicture(VolumeRenderer(scene, {target}), view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                row.saw(std::abs(image.viewDepth.at(x, y) - std::max(depth, near)) / near);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, NearWallRow, testing::Values(-1e-3, -1e-5, 0.0, 1e-5, 1e-3, 0.5),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

// ---- offsets of values

class OffsetRow : public testing::TestWithParam<std::tuple<double, double>> {};

// The same stored numbers under another scale and offset, with a transfer function moved along: the same
// picture, but for the rounding of the function's values.
TEST_P(OffsetRow, TranslucentPictureIsTheSame) {
    const auto [scale, offset] = GetParam();
    StabilityRow row("offset/translucent/" + shortNumber(scale) + "/" + shortNumber(offset),
                     "values of scale " + shortNumber(scale) + " and offset " + shortNumber(offset),
                     "largest difference of colours", 1, "levels of 1,023");
    const auto sceneWith = [&](double s, double o) {
        VolumeScene scene = ballScene(glm::dvec3(0));
        scene.field.scale = s;
        scene.field.offset = o;
        scene.look.transfer = TransferFunction({{-900 * s + o, glm::vec3(1.0f, 0.5f, 0.3f), 0},
                                                {-400 * s + o, glm::vec3(0.8f), 0.4},
                                                {40 * s + o, glm::vec3(0.5f), 0.9}},
                                               0.001, "test");
        SurfaceSetting setting{-480, -900, 40, nullptr};
        Progress quiet;
        scene.cells = findSurfaceCells(scene.field, setting, quiet);
        return scene;
    };
    const VolumeScene plain = sceneWith(1, 0), moved = sceneWith(scale, offset);
    const EyeView view =
        makeEyeView(poseFromAngles(glm::dvec3(0.02), 0.4, 0.2, 0.1), {33, 27, 1.2, 1.0, 1e-4});
    for (const SimdTarget target : simdTargets()) {
        const EyeImage a = castPicture(VolumeRenderer(plain, {target}), view);
        const EyeImage b = castPicture(VolumeRenderer(moved, {target}), view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                for (int shift = 0; shift < 30; shift += 10)
                    row.saw(std::abs(double(a.color.at(x, y) >> shift & 1023u) -
                                     double(b.color.at(x, y) >> shift & 1023u)));
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, OffsetRow,
                         testing::Values(std::make_tuple(1.0, 1e6), std::make_tuple(1.0, -1e6),
                                         std::make_tuple(1e-6, 0.0), std::make_tuple(1e6, 1e9),
                                         std::make_tuple(1e-3, 1e6)),
                         [](const auto& given) {
                             return testName(shortNumber(std::get<0>(given.param)) + "_" +
                                             shortNumber(std::get<1>(given.param)));
                         });

}  // namespace
}  // namespace stereonav
