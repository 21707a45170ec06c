// Lumens from ready masks: which voxels are inside, how near the wall is to the truth, pieces and their
// order, and one clear line for what can not be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "colon/segmentation/segmentation.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

VolumeFrame frameOf(const glm::ivec3& size, const glm::dvec3& spacing = glm::dvec3(0.001)) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = spacing;
    frame.origin = {0.1, -0.2, 0.3};
    return frame;
}

// inside(world - origin of the frame)
MaskVolume maskWhere(const VolumeFrame& frame, const std::function<bool(glm::dvec3)>& inside) {
    MaskVolume mask(frame);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                mask.at(i, j, k) = inside(glm::dvec3(i, j, k) * frame.spacing);
    return mask;
}

LumenField lumenOf(const MaskVolume& mask, const std::vector<glm::dvec3>& seeds = {}) {
    SegmentationSetting setting;
    setting.seeds = seeds;
    Progress progress;
    return lumenFromMask(mask, setting, progress);
}

std::string maskErrorOf(const MaskVolume& mask, const std::vector<glm::dvec3>& seeds = {}) {
    try {
        lumenOf(mask, seeds);
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

// The lumen is the mask, voxel for voxel, and the field agrees.
void expectIsMask(const LumenField& lumen, const MaskVolume& mask) {
    ASSERT_EQ(lumen.lumen.frame.size, lumen.field.frame.size);
    const VolumeFrame& frame = lumen.field.frame;
    std::size_t voxels = 0, wrong = 0, wrongField = 0;
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const glm::dvec3 world = frame.worldFromVoxel({i, j, k});
                const glm::ivec3 at(glm::floor(mask.frame.voxelFromWorld(world) + 0.5));
                const bool inMask = mask.frame.contains(at) && mask.at(at) != 0;
                voxels += inMask;
                wrong += inMask != (lumen.lumen.at(i, j, k) != 0);
                wrongField += inMask != (lumen.field.at(i, j, k) < lumen.isovalue);
            }
    EXPECT_GT(voxels, 0u);
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(wrongField, 0u);
}

// Distances of the wall (where it crosses the grid's lines along i) to a true surface, metres.
double farthestWall(const LumenField& lumen, const glm::dvec3& origin,
                    const std::function<double(glm::dvec3)>& distance) {
    double farthest = 0;
    int crossings = 0;
    const VolumeFrame& frame = lumen.field.frame;
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i + 1 < frame.size.x; ++i) {
                const double a = lumen.field.at(i, j, k) - lumen.isovalue;
                const double b = lumen.field.at(i + 1, j, k) - lumen.isovalue;
                if ((a < 0) == (b < 0)) continue;
                const glm::dvec3 hit = frame.worldFromVoxel({i + a / (a - b), j, k});
                farthest = std::max(farthest, std::abs(distance(hit - origin)));
                ++crossings;
            }
    EXPECT_GT(crossings, 0);
    return farthest;
}

TEST(LumenFromMask, ASphereKeepsItsVoxelsAndItsPlaceInSpace) {
    const VolumeFrame frame = frameOf({60, 50, 70}, {0.0008, 0.001, 0.0006});
    const glm::dvec3 middle(0.024, 0.025, 0.021);
    const auto distance = [&](glm::dvec3 p) { return glm::distance(p, middle) - 0.012; };
    const MaskVolume mask = maskWhere(frame, [&](glm::dvec3 p) { return distance(p) < 0; });
    const LumenField lumen = lumenOf(mask);
    expectIsMask(lumen, mask);
    EXPECT_LT(farthestWall(lumen, frame.origin, distance), 0.0006);  // the smallest spacing
    ASSERT_EQ(lumen.segments.size(), 1u);
    EXPECT_NEAR(lumen.segments[0].volume, 4.18879 * 0.012 * 0.012 * 0.012, 1e-7);
}

// Mean errors of a wall whose distance is known: of its place, and of its normals (by differences of the
// field over a voxel in both directions).
struct WallErrors {
    double rms_voxels = 0, mean_deg = 0;
};
WallErrors wallErrors(const std::function<double(glm::dvec3)>& distance) {
    constexpr int kSide = 56, kLeft = 14;  // what the volume's faces change is left out
    const VolumeFrame frame = frameOf(glm::ivec3(kSide));
    const LumenField lumen = lumenOf(maskWhere(frame, [&](glm::dvec3 p) {
        const glm::dvec3 v = p / 0.001;
        const bool within = glm::all(glm::greaterThan(v, glm::dvec3(2.5))) &&
                            glm::all(glm::lessThan(v, glm::dvec3(kSide - 3.5)));
        return within && distance(v) < 0;
    }));
    const GreyVolume& field = lumen.field;
    const auto voxelAt = [&](int i, int j, int k) {
        return frame.voxelFromWorld(field.frame.worldFromVoxel({i, j, k}));
    };
    const auto gradient = [&](glm::ivec3 at) {
        return glm::dvec3(field.at(at.x + 1, at.y, at.z) - field.at(at.x - 1, at.y, at.z),
                          field.at(at.x, at.y + 1, at.z) - field.at(at.x, at.y - 1, at.z),
                          field.at(at.x, at.y, at.z + 1) - field.at(at.x, at.y, at.z - 1));
    };
    WallErrors errors;
    int count = 0;
    for (int k = 1; k + 1 < field.frame.size.z; ++k)
        for (int j = 1; j + 1 < field.frame.size.y; ++j)
            for (int i = 1; i + 1 < field.frame.size.x; ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    glm::ivec3 next(i, j, k);
                    ++next[axis];
                    const double a = field.at(i, j, k) - lumen.isovalue,
                                 b = field.at(next.x, next.y, next.z) - lumen.isovalue;
                    if ((a < 0) == (b < 0)) continue;
                    const double share = a / (a - b);
                    const glm::dvec3 hit = glm::mix(voxelAt(i, j, k), voxelAt(next.x, next.y, next.z), share);
                    if (glm::any(glm::lessThan(hit, glm::dvec3(kLeft))) ||
                        glm::any(glm::greaterThan(hit, glm::dvec3(kSide - kLeft))) ||
                        glm::any(glm::greaterThanEqual(next, field.frame.size - 1)))
                        continue;
                    const glm::dvec3 normal =
                        glm::normalize(glm::mix(gradient({i, j, k}), gradient(next), share));
                    glm::dvec3 truth(0.0);
                    for (int c = 0; c < 3; ++c) {
                        glm::dvec3 step(0.0);
                        step[c] = 1e-4;
                        truth[c] = distance(hit + step) - distance(hit - step);
                    }
                    errors.rms_voxels += distance(hit) * distance(hit);
                    errors.mean_deg +=
                        std::acos(std::min(1.0, glm::dot(normal, glm::normalize(truth)))) * 57.29578;
                    ++count;
                }
    EXPECT_GT(count, 500);
    errors.rms_voxels = std::sqrt(errors.rms_voxels / count);
    errors.mean_deg /= count;
    return errors;
}

// The voxel centres of a mask leave half a voxel open to either side; in it the wall is as smooth as its
// shape. With a plain Gaussian of 1.5 voxels normals were off by 2.3, 2.9 and 4.9 degrees.
TEST(LumenFromMask, WallsShowNoStairs) {
    const glm::dvec3 middle(27.7, 28.2, 28.4);
    const WallErrors sphere = wallErrors([&](glm::dvec3 p) { return glm::distance(p, middle) - 12; });
    EXPECT_LT(sphere.rms_voxels, 0.2);
    EXPECT_LT(sphere.mean_deg, 2.2);
    const glm::dvec3 along = glm::normalize(glm::dvec3(1, 0.12, 0.07));
    const WallErrors tube = wallErrors([&](glm::dvec3 p) {
        p -= middle;
        return glm::length(p - along * glm::dot(along, p)) - 8;
    });
    EXPECT_LT(tube.rms_voxels, 0.18);
    EXPECT_LT(tube.mean_deg, 2.5);
    const glm::dvec3 up = glm::normalize(glm::dvec3(-1, -0.31, 8));
    const WallErrors plane = wallErrors([&](glm::dvec3 p) { return glm::dot(up, p - middle); });
    EXPECT_LT(plane.rms_voxels, 0.1);
    EXPECT_LT(plane.mean_deg, 3.4);
}

TEST(LumenFromMask, ThinWallsAndThinNecksStay) {
    const MaskVolume mask = maskWhere(frameOf({40, 30, 30}), [](glm::dvec3 p) {
        const glm::ivec3 v(glm::floor(p * 1000.0 + 0.5));
        const bool box = glm::all(glm::greaterThan(v, glm::ivec3(5))) && v.x < 34 && v.y < 24 && v.z < 24;
        const bool wall = v.x == 20 && !(v.y == 12 && v.z == 12);  // one voxel of tissue, one voxel of neck
        return box && !wall;
    });
    const LumenField lumen = lumenOf(mask);
    expectIsMask(lumen, mask);
    EXPECT_EQ(lumen.segments.size(), 1u);
}

TEST(LumenFromMask, ALumenThatTouchesTheFacesIsClosedBeyondThem) {
    const MaskVolume mask = maskWhere(frameOf({20, 20, 20}), [](glm::dvec3 p) { return p.x < 0.0105; });
    const LumenField lumen = lumenOf(mask);
    expectIsMask(lumen, mask);
    EXPECT_EQ(lumen.field.frame.size, glm::ivec3(4 + 11 + 4, 28, 28));
    for (int j = 0; j < 28; ++j) EXPECT_EQ(lumen.lumen.at(6, j, 0), 0) << j;
}

TEST(LumenFromMask, PiecesAreOrderedFromTheRectumAndSpecksLeftOut) {
    // Three tubes up the z axis: low in the back, in the middle, low in front; and a speck.
    const MaskVolume mask = maskWhere(frameOf({40, 80, 100}), [](glm::dvec3 p) {
        const glm::ivec3 v(glm::floor(p * 1000.0 + 0.5));
        if (v == glm::ivec3(30, 40, 50)) return true;
        if (v.x < 5 || v.x > 14) return false;
        if (v.y >= 60 && v.y < 70) return v.z > 5 && v.z < 40;
        if (v.y >= 35 && v.y < 45) return v.z > 45 && v.z < 90;
        return v.y >= 10 && v.y < 20 && v.z > 5 && v.z < 95;
    });
    const LumenField lumen = lumenOf(mask);
    ASSERT_EQ(lumen.segments.size(), 3u);
    ASSERT_EQ(lumen.notes.size(), 1u);
    EXPECT_THAT(lumen.notes[0], HasSubstr("1 piece"));
    const auto numberAt = [&](int i, int j, int k) {
        const glm::dvec3 voxel = lumen.lumen.frame.voxelFromWorld(mask.frame.worldFromVoxel({i, j, k}));
        return static_cast<int>(lumen.lumen.at(glm::ivec3(glm::floor(voxel + 0.5))));
    };
    EXPECT_EQ(numberAt(10, 65, 20), 1);
    EXPECT_EQ(numberAt(10, 40, 60), 2);
    EXPECT_EQ(numberAt(10, 15, 50), 3);
}

TEST(LumenFromMask, TheSameOnAnyNumberOfThreads) {
    const MaskVolume mask = maskWhere(frameOf({90, 40, 80}), [](glm::dvec3 p) {
        return std::sin(p.x * 300) + std::sin(p.y * 250) + std::sin(p.z * 200) < -0.3;
    });
    const int threads = threadCount();
    setThreadCount(1);
    const LumenField one = lumenOf(mask);
    setThreadCount(3);
    const LumenField three = lumenOf(mask);
    setThreadCount(threads);
    ASSERT_EQ(one.field.values.size(), three.field.values.size());
    EXPECT_TRUE(std::equal(one.field.values.data(), one.field.values.data() + one.field.values.size(),
                           three.field.values.data()));
    EXPECT_TRUE(std::equal(one.lumen.values.data(), one.lumen.values.data() + one.lumen.values.size(),
                           three.lumen.values.data()));
}

TEST(LumenFromMask, BadMasksAndSeedsAreNamed) {
    const VolumeFrame frame = frameOf({20, 20, 20});
    EXPECT_THAT(maskErrorOf(maskWhere(frame, [](glm::dvec3) { return false; })), HasSubstr("found none"));
    EXPECT_THAT(maskErrorOf(maskWhere(frame, [](glm::dvec3) { return true; })), HasSubstr("all are inside"));
    const MaskVolume ball =
        maskWhere(frame, [](glm::dvec3 p) { return glm::distance(p, glm::dvec3(0.01)) < 0.005; });
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(maskErrorOf(ball, {{0.11, nan, 0.31}}), HasSubstr("finite"));
    EXPECT_THAT(maskErrorOf(ball, {{1e30, 0, 0}}), HasSubstr("outside the volume"));
    EXPECT_THAT(maskErrorOf(ball, {{0.101, -0.199, 0.301}}), HasSubstr("--seed 101,-199,301"));
    EXPECT_EQ(maskErrorOf(ball, {{0.11, -0.19, 0.31}}), "no error");
}

TEST(LumenFromMask, OneVoxelIsALumen) {
    const MaskVolume mask = maskWhere(frameOf({1, 1, 2}), [](glm::dvec3 p) { return p.z < 0.0005; });
    const LumenField lumen = lumenOf(mask);
    expectIsMask(lumen, mask);
    ASSERT_EQ(lumen.segments.size(), 1u);
    EXPECT_EQ(lumen.segments[0].voxels, 1u);
}

}  // namespace
}  // namespace stereonav
