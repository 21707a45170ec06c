// Masks of known shapes, smoothed: how far normals are off, how far the wall moves, what it encloses, what
// stays connected; and masks of nothing, of everything and of one voxel.
#include "colon/segmentation/mask_smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <string>

#include "colon/segmentation/lumen_surface.h"
#include "colon/segmentation/segmentation.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/volume/surface_cells.h"

namespace stereonav {
namespace {

template <typename T>
std::span<const T> numbersOf(const Volume<T>& volume) {
    return {volume.values.data(), volume.frame.count()};
}

using Shape = std::function<double(const glm::dvec3&)>;  // signed distance, millimetres; below 0 inside

constexpr int kBorder = 4;  // voxels at the faces that are outside

struct Mask {
    std::string name;
    Shape shape;
    MaskVolume voxels;

    Mask(std::string called, const glm::ivec3& size, const glm::dvec3& spacing_mm, Shape of)
        : name(std::move(called)), shape(std::move(of)) {
        VolumeFrame frame;
        frame.size = size;
        frame.spacing = 0.001 * spacing_mm;
        voxels = MaskVolume(frame);
        for (int k = kBorder; k < size.z - kBorder; ++k)
            for (int j = kBorder; j < size.y - kBorder; ++j)
                for (int i = kBorder; i < size.x - kBorder; ++i)
                    voxels.at(i, j, k) = shape(glm::dvec3(i, j, k) * spacing_mm) < 0;
    }
    double voxelCount() const { return static_cast<double>(std::ranges::count(numbersOf(voxels), 1)); }
};

GreyVolume smoothed(const Mask& mask, double voxels = 2) {
    GreyVolume field(mask.voxels.frame);
    Progress progress;
    const glm::dvec3 spacing = field.frame.spacing;
    smoothWall(runsOf(mask.voxels), voxels * std::max({spacing.x, spacing.y, spacing.z}), field, progress);
    return field;
}
GreyVolume widelySmoothed(const Mask& mask) {
    GreyVolume field(mask.voxels.frame);
    Progress progress;
    smoothMask(runsOf(mask.voxels), {}, field, progress);
    return field;
}

double valueAt(const GreyVolume& field, const glm::dvec3& place) {
    const glm::ivec3 low(glm::floor(place));
    const glm::dvec3 t = place - glm::dvec3(low);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 weight = glm::mix(1.0 - t, t, glm::dvec3(step));
        sum += weight.x * weight.y * weight.z * field.at(low + step);
    }
    return sum - kMaskWall;
}

// The normal that is shown: those of a cell's corners, mixed.
glm::dvec3 normalAt(const GreyVolume& field, const glm::dvec3& place) {
    const glm::ivec3 low(glm::floor(place));
    const glm::dvec3 t = place - glm::dvec3(low);
    glm::dvec3 sum(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 weight = glm::mix(1.0 - t, t, glm::dvec3(step));
        const glm::dvec3 slope = smoothGradient(field, glm::dvec3(low + step));
        if (glm::length(slope) > 0) sum += weight.x * weight.y * weight.z * glm::normalize(slope);
    }
    return glm::normalize(sum);
}

glm::dvec3 trueNormal(const Shape& shape, const glm::dvec3& mm) {
    constexpr double kStep = 1e-4;
    glm::dvec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = kStep;
        slope[axis] = shape(mm + step) - shape(mm - step);
    }
    return glm::normalize(slope);
}

// Distance of a place from the faces between voxels of the mask that differ, in voxels along each axis.
double fromFaces(const MaskVolume& mask, const glm::dvec3& place) {
    const glm::ivec3 own(glm::floor(place + 0.5));
    double least = 9;
    for (int k = -2; k <= 2; ++k)
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i) {
                const glm::ivec3 at = own + glm::ivec3(i, j, k);
                if (mask.at(at) == mask.at(own)) continue;
                const glm::dvec3 away = glm::max(glm::abs(place - glm::dvec3(at)) - 0.5, 0.0);
                least = std::min(least, glm::length(away));
            }
    return least;
}

// Returns how many of a cell's eight corners are inside.
int cornersInside(const GreyVolume& field, const glm::ivec3& cell) {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner)
        inside += field.at(cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2)) < kMaskWall;
    return inside;
}

// Calls use(place) where the wall crosses lines through voxel centres and half way between them.
template <typename Use>
void forWall(const GreyVolume& field, int left, const Use& use) {
    const glm::ivec3 size = field.frame.size;
    for (int k = left; k < size.z - left; ++k)
        for (int j = left; j < size.y - left; ++j)
            for (int i = left; i < size.x - left; ++i) {
                if (cornersInside(field, {i, j, k}) % 8 == 0) continue;
                for (int line = 0; line < 6; ++line) {
                    glm::dvec3 from(i, j, k), step(0.0);
                    step[line % 3] = 1;
                    if (line >= 3) from += 0.5 * (1.0 - step);
                    const double a = valueAt(field, from), b = valueAt(field, from + (1 - 1e-9) * step);
                    if ((a < 0) != (b < 0)) use(from + a / (a - b) * step);
                }
            }
}

struct Errors {
    double normals_deg = 0;  // root of the mean square
    double moved = 0;        // most, from the mask's faces, voxels
    double volume = 0;       // share of the mask's that was gained
};

double volumeOf(const GreyVolume& field) {
    constexpr int kParts = 4;
    constexpr int kAll = kParts * kParts * kParts;
    const glm::ivec3 size = field.frame.size;
    int inside = 0;
    for (int k = 0; k + 1 < size.z; ++k)
        for (int j = 0; j + 1 < size.y; ++j)
            for (int i = 0; i + 1 < size.x; ++i) {
                const int corners = cornersInside(field, {i, j, k});
                if (corners == 8) inside += kAll;
                if (corners % 8 == 0) continue;
                for (int part = 0; part < kAll; ++part) {
                    const glm::dvec3 at(part % kParts, part / kParts % kParts, part / (kParts * kParts));
                    inside += valueAt(field, glm::dvec3(i, j, k) + (at + 0.5) / double(kParts)) < 0;
                }
            }
    return inside / double(kAll);
}

Errors errorsOf(const Mask& mask, const GreyVolume& field, int left) {
    Errors errors;
    double squares = 0;
    int count = 0;
    const glm::dvec3 spacing_mm = 1000.0 * mask.voxels.frame.spacing;
    forWall(field, left, [&](const glm::dvec3& place) {
        const double cosine = glm::dot(trueNormal(mask.shape, place * spacing_mm), normalAt(field, place));
        squares += std::pow(std::acos(std::clamp(cosine, -1.0, 1.0)), 2);
        errors.moved = std::max(errors.moved, fromFaces(mask.voxels, place));
        ++count;
    });
    EXPECT_GT(count, 100) << mask.name;
    errors.normals_deg = std::sqrt(squares / count) * 57.29578;
    errors.volume = volumeOf(field) / mask.voxelCount() - 1;
    return errors;
}

std::size_t voxelsOnAnotherSide(const Mask& mask, const GreyVolume& field) {
    std::size_t wrong = 0;
    for (std::size_t n = 0; n < mask.voxels.frame.count(); ++n)
        wrong += (mask.voxels.values[n] != 0) != (field.values[n] < kMaskWall);
    return wrong;
}

Shape sphere(double radius, const glm::dvec3& middle) {
    return [=](const glm::dvec3& p) { return glm::distance(p, middle) - radius; };
}
Shape below(const glm::dvec3& normal, double at) {
    return [=, n = glm::normalize(normal)](const glm::dvec3& p) { return glm::dot(n, p) - at; };
}
// All but a slanted septum.
Shape septum(double thickness) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 0.23, 0.31));
    return [=](const glm::dvec3& p) { return thickness / 2 - std::abs(glm::dot(p - 24.0, normal)); };
}
double torus(const glm::dvec3& p) {
    const glm::dvec3 from = p - glm::dvec3(23.6, 23.3, 13.7);
    return std::hypot(std::hypot(from.x, from.y) - 12, from.z) - 4;
}
// A tube of one voxel along x.
double thread(const glm::dvec3& p) {
    return std::max(std::abs(p.y - 12), std::abs(p.z - 12)) - 0.5;
}

struct Bounds {
    Mask mask;
    double normals_deg;  // after
    double better;       // at least by this factor than the wide kernel; 0: not asked
    double volume;
    int left = kBorder + 2;  // voxels at the faces that are not looked at
};

TEST(MaskSmoothing, HoldsItsBoundsOnKnownShapes) {
    const glm::dvec3 one(1.0);
    const Bounds all[] = {
        {{"sphere of 5", {26, 26, 26}, one, sphere(5, {12.7, 12.4, 12.9})}, 1.6, 2, 0.006},
        {{"sphere of 12", {42, 42, 42}, one, sphere(12, {20.7, 20.4, 20.9})}, 1.7, 0, 0.002},
        {{"torus", {48, 48, 28}, one, torus}, 2.4, 0, 0.003},
        {{"plane 1:8", {48, 48, 48}, one, below({0.125, 0.06, 1}, 24.3)}, 3.5, 0, 0.004, 12},
        {{"septum of 3", {48, 48, 48}, one, septum(3)}, 1.5, 0, 0.004, 12},
        {{"septum of 2", {48, 48, 48}, one, septum(2)}, 3, 8, 0.004, 12},
        {{"septum of 1.4", {48, 48, 48}, one, septum(1.4)}, 8, 5, 0.004, 12},
        {{"uneven spacing", {42, 42, 24}, {1, 1, 2.5}, sphere(12, {20.7, 20.4, 29.9})}, 2.6, 0, 0.006}};
    for (const Bounds& bounds : all) {
        const GreyVolume field = smoothed(bounds.mask);
        const Errors errors = errorsOf(bounds.mask, field, bounds.left);
        EXPECT_EQ(voxelsOnAnotherSide(bounds.mask, field), 0u) << bounds.mask.name;
        EXPECT_LT(errors.normals_deg, bounds.normals_deg) << bounds.mask.name;
        EXPECT_LT(errors.moved, 0.5) << bounds.mask.name;
        EXPECT_LT(std::abs(errors.volume), bounds.volume) << bounds.mask.name;
        if (bounds.better == 0) continue;
        const Errors before = errorsOf(bounds.mask, widelySmoothed(bounds.mask), bounds.left);
        EXPECT_GT(before.normals_deg, bounds.better * errors.normals_deg) << bounds.mask.name;
    }
}

TEST(MaskSmoothing, LengthsFromNothingToTheMostHoldTheBounds) {
    const Mask mask("torus", {48, 48, 28}, glm::dvec3(1), torus);
    double last = 90;
    for (const double voxels : {0.01, 0.5, 1.0, 2.0}) {
        const GreyVolume field = smoothed(mask, voxels);
        const Errors errors = errorsOf(mask, field, kBorder + 2);
        EXPECT_EQ(voxelsOnAnotherSide(mask, field), 0u) << voxels;
        EXPECT_LT(errors.moved, 0.5) << voxels;
        EXPECT_LT(std::abs(errors.volume), 0.02) << voxels;
        EXPECT_LE(errors.normals_deg, last) << voxels;
        last = errors.normals_deg;
    }
    const Errors most = errorsOf(mask, smoothed(mask, kMostSmoothed), kBorder + 2);
    EXPECT_LT(most.moved, 0.5);
    EXPECT_LT(std::abs(most.volume), 0.01);
}

TEST(MaskSmoothing, AThreadOfOneVoxelStaysWhole) {
    const Mask mask("thread", {40, 24, 24}, glm::dvec3(1), thread);
    const GreyVolume field = smoothed(mask);
    EXPECT_EQ(voxelsOnAnotherSide(mask, field), 0u);
    for (double x = kBorder; x <= 40 - kBorder - 1; x += 0.25) EXPECT_LT(valueAt(field, {x, 12, 12}), 0) << x;
    EXPECT_EQ(connectedComponents(runsBelow(field, kMaskWall)).list.size(), 1u);
    // Half a voxel wide at least, on either side of the middle.
    EXPECT_LT(valueAt(field, {20, 12.25, 12}), 0);
    EXPECT_LT(valueAt(field, {20, 12, 11.75}), 0);
}

TEST(MaskSmoothing, PiecesThatTouchByAnEdgeStayApart) {
    const Mask mask("two boxes", {24, 24, 24}, glm::dvec3(1), [](const glm::dvec3& p) {
        const glm::dvec3 q = glm::abs(p - 11.5);
        return (p.x < 11.5) == (p.y < 11.5) ? std::max({q.x, q.y, q.z}) - 5 : 1.0;
    });
    const GreyVolume field = smoothed(mask);
    EXPECT_EQ(voxelsOnAnotherSide(mask, field), 0u);
    EXPECT_EQ(connectedComponents(runsBelow(field, kMaskWall)).list.size(), 2u);
}

TEST(MaskSmoothing, OfNothingEverythingAndOneVoxel) {
    const Mask nothing("nothing", {9, 8, 7}, glm::dvec3(1), [](const glm::dvec3&) { return 1.0; });
    const GreyVolume none = smoothed(nothing);
    EXPECT_EQ(std::ranges::count(numbersOf<std::int16_t>(none), kMaskOutside), 9 * 8 * 7);

    Mask everything("everything", {9, 8, 7}, glm::dvec3(1), [](const glm::dvec3&) { return 1.0; });
    std::fill_n(everything.voxels.values.data(), 9 * 8 * 7, std::uint8_t{1});
    const GreyVolume all = smoothed(everything);
    EXPECT_EQ(std::ranges::count(numbersOf<std::int16_t>(all), kMaskInside), 9 * 8 * 7);

    const Mask one("one voxel", {9, 9, 9}, glm::dvec3(1), sphere(0.5, {4, 4, 4}));
    ASSERT_EQ(one.voxelCount(), 1);
    const GreyVolume voxel = smoothed(one);
    EXPECT_EQ(voxelsOnAnotherSide(one, voxel), 0u);
    EXPECT_LT(valueAt(voxel, {4.25, 4, 4}), 0);

    Mask slab("one row", {1, 1, 5}, glm::dvec3(1), [](const glm::dvec3&) { return 1.0; });
    slab.voxels.at(0, 0, 2) = 1;
    EXPECT_EQ(voxelsOnAnotherSide(slab, smoothed(slab)), 0u);
}

TEST(MaskSmoothing, DoesNotDependOnThreads) {
    const Mask mask("sphere", {80, 70, 60}, {1, 1.2, 0.7}, sphere(18, {40, 41, 20}));
    const int before = threadCount();
    setThreadCount(1);
    const GreyVolume one = smoothed(mask);
    setThreadCount(3);
    const GreyVolume three = smoothed(mask);
    setThreadCount(before);
    EXPECT_TRUE(std::ranges::equal(numbersOf<std::int16_t>(one), numbersOf<std::int16_t>(three)));
}

TEST(MaskSmoothing, AsksForItsMemoryBefore) {
    const Mask mask("noise", {40, 40, 40}, glm::dvec3(1),
                    [](const glm::dvec3& p) { return std::sin(9.1 * p.x * p.y + 7.3 * p.z); });
    limitMemory(1);
    std::string problem;
    try {
        smoothed(mask);
    } catch (const Error& error) {
        problem = error.what();
    }
    limitMemory(0);
    EXPECT_NE(problem.find("--mask-smoothing 0"), std::string::npos) << problem;
}

TEST(MaskSmoothing, LengthIsOfTheCoarsestSpacingAndLimited) {
    VolumeFrame frame;
    frame.spacing = {0.001, 0.0005, 0.0025};
    EXPECT_DOUBLE_EQ(smoothedLength({}, frame), 0.005);
    EXPECT_DOUBLE_EQ(smoothedLength(0.0, frame), 0);
    EXPECT_DOUBLE_EQ(smoothedLength(0.003, frame), 0.003);
    EXPECT_DOUBLE_EQ(smoothedLength(1.0, frame), 0.0025 * kMostSmoothed);
}

// Volumes of segments are those of the mask, whatever is smoothed.
TEST(MaskSmoothing, OfALumenKeepsItsVoxelsAndVolumes) {
    const Mask mask("torus", {48, 48, 28}, glm::dvec3(1), torus);
    SegmentationSetting plain, smooth;
    smooth.maskSmoothing = MaskSmoothing();
    Progress progress;
    const LumenField before = lumenFromMask(mask.voxels, plain, progress);
    const LumenField after = lumenFromMask(mask.voxels, smooth, progress);
    EXPECT_TRUE(std::ranges::equal(numbersOf(before.lumen), numbersOf(after.lumen)));
    ASSERT_EQ(after.segments.size(), 1u);
    EXPECT_EQ(after.segments[0].volume, before.segments[0].volume);
    EXPECT_FALSE(
        std::ranges::equal(numbersOf<std::int16_t>(before.field), numbersOf<std::int16_t>(after.field)));
    EXPECT_EQ(runsOf(after.lumen).voxelCount(), runsBelow(after.field, after.isovalue).voxelCount());
}

}  // namespace
}  // namespace stereonav
