// The generated colon, segmented from its own CT: against the implicit function that it was sampled from,
// which the segmentation knows nothing of, and against its list of polyps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "colon/built_in/built_in_anatomy.h"
#include "colon/segmentation/segmentation.h"
#include "engine/base/parallel.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

constexpr double kGap = 4;  // mm: of a full-size colon, see builtInColon

struct Segmented {
    BuiltInAnatomy anatomy{1, kGap};
    BuiltInColon colon;
    LumenField lumen;
};
const Segmented& fullSize() {
    static const Segmented segmented = [] {
        Segmented s;
        Progress progress;
        s.colon = builtInColon({1, {512, 512, 411}}, progress);
        s.lumen = segmentColon(s.colon.grey, {}, progress);
        return s;
    }();
    return segmented;
}

// Axis points that may be the nearest of any point within `reach` mm of `middle`.
std::vector<int> candidatesNear(const BuiltInAnatomy& anatomy, const glm::dvec3& middle, double reach) {
    const auto away = [&](const AxisPoint& p) { return glm::length(middle - p.place) - p.radius; };
    double least = 1e30;
    for (const AxisPoint& point : anatomy.axis()) least = std::min(least, away(point));
    std::vector<int> candidates;
    for (std::size_t n = 0; n < anatomy.axis().size(); ++n)
        if (least < reach + 3 && away(anatomy.axis()[n]) <= least + 2 * reach)
            candidates.push_back(static_cast<int>(n));
    return candidates;
}

struct Overlap {
    std::size_t truth = 0, found = 0, both = 0;
};

// Voxels of one block of 8^3 of the study.
Overlap overlapIn(const Segmented& s, const glm::ivec3& corner) {
    const VolumeFrame& study = s.colon.grey.frame;
    const glm::dvec3 middle = study.worldFromVoxel(glm::dvec3(corner) + 3.5) * 1000.0;
    const std::vector<int> candidates =
        candidatesNear(s.anatomy, middle, 4 * glm::length(study.spacing) * 1000);
    const glm::ivec3 shift(
        glm::round(study.voxelFromWorld(s.lumen.lumen.frame.worldFromVoxel(glm::dvec3(0)))));
    Overlap sum;
    for (int n = 0; n < 512; ++n) {
        const glm::ivec3 v = corner + glm::ivec3(n & 7, n >> 3 & 7, n >> 6);
        if (!study.contains(v)) continue;
        const bool found = s.lumen.lumen.frame.contains(v - shift) && s.lumen.lumen.at(v - shift) != 0;
        const bool truth =
            !candidates.empty() && s.anatomy
                                           .placeOf(study.worldFromVoxel(glm::dvec3(v)) * 1000.0,
                                                    candidates.data(), static_cast<int>(candidates.size()))
                                           .wall < 0;
        sum.truth += truth;
        sum.found += found;
        sum.both += truth && found;
    }
    return sum;
}

TEST(BuiltInSegmentationNightly, DiceAgainstTheTrueLumen) {
    const Segmented& s = fullSize();
    const glm::ivec3 blocks = (s.colon.grey.frame.size + 7) / 8;
    std::vector<Overlap> layers(static_cast<std::size_t>(blocks.z));
    parallelFor(blocks.z, [&](int k) {
        for (int j = 0; j < blocks.y; ++j)
            for (int i = 0; i < blocks.x; ++i) {
                const Overlap part = overlapIn(s, glm::ivec3(i, j, k) * 8);
                layers[k].truth += part.truth;
                layers[k].found += part.found;
                layers[k].both += part.both;
            }
    });
    Overlap all;
    for (const Overlap& layer : layers) {
        all.truth += layer.truth;
        all.found += layer.found;
        all.both += layer.both;
    }
    const double dice = 2.0 * static_cast<double>(all.both) / static_cast<double>(all.truth + all.found);
    std::printf("Dice %.4f (truth %zu, found %zu voxels)\n", dice, all.truth, all.found);
    EXPECT_GT(all.truth, 1'000'000u);
    EXPECT_GE(dice, 0.98);
    EXPECT_EQ(s.lumen.segments.size(), 1u);
}

// Near the wall, steps of 0.05 mm change what is about the distance to it by little more: folds have no tears
// and bends no creases.
TEST(BuiltInAnatomy, TheWallIsOfOnePiece) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const BuiltInAnatomy anatomy(seed, kGap);
        std::mt19937 random(static_cast<unsigned>(seed));
        std::uniform_real_distribution<double> unit(0, 1);
        const auto direction = [&] {
            const double z = 2 * unit(random) - 1, angle = 6.2831853 * unit(random), r = std::sqrt(1 - z * z);
            return glm::dvec3(r * std::cos(angle), r * std::sin(angle), z);
        };
        int near = 0;
        double most = 0;
        for (int n = 0; n < 6000; ++n) {
            const AxisPoint& point =
                anatomy.axis()[static_cast<std::size_t>(unit(random) * anatomy.length())];
            const glm::dvec3 p = point.place + direction() * point.radius * (0.4 + 0.7 * unit(random));
            const double wall = anatomy.placeOf(p).wall;
            if (std::abs(wall) > 2) continue;
            ++near;
            const double steepness = std::abs(anatomy.placeOf(p + 0.05 * direction()).wall - wall) / 0.05;
            most = std::max(most, steepness);
            ASSERT_LT(steepness, 4) << "seed " << seed << " at " << p.x << ' ' << p.y << ' ' << p.z;
        }
        std::printf("seed %d: %d places near the wall, steepest %.2f\n", static_cast<int>(seed), near, most);
        EXPECT_GT(near, 1000);
    }
}

// Returns the segmented field at a place in mm, minus the wall's value: negative in the lumen.
double fieldAt(const LumenField& lumen, const glm::dvec3& mm) {
    return plainValue(lumen.field, lumen.field.frame.voxelFromWorld(mm * 0.001)) - lumen.isovalue;
}

// mm from a place in flesh to the wall along a direction; -1 where there is none within `reach`.
double wallAlong(const LumenField& lumen, const glm::dvec3& from, const glm::dvec3& direction, double reach) {
    for (double way = 0; way < reach; way += 0.05)
        if (fieldAt(lumen, from + way * direction) < 0) return way;
    return -1;
}

glm::dvec3 anyAcross(const glm::dvec3& v) {
    const glm::dvec3 other = std::abs(v.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(v, other));
}

// The top of a polyp is where the wall lies along its axis, and the polyp has the width that it was made
// with.
TEST(BuiltInSegmentationNightly, PolypsAreOnTheSegmentedWall) {
    const Segmented& s = fullSize();
    ASSERT_EQ(s.anatomy.polyps().size(), s.colon.polyps.size());
    ASSERT_GE(s.anatomy.polyps().size(), 10u);
    int wide = 0;
    for (std::size_t n = 0; n < s.anatomy.polyps().size(); ++n) {
        const BuiltInPolyp& polyp = s.anatomy.polyps()[n];
        SCOPED_TRACE(testing::Message()
                     << "polyp of " << 2 * polyp.across << " mm at " << polyp.data.along * 1000 << " mm");
        EXPECT_LT(glm::length(polyp.head - s.colon.polyps[n].position * 1000.0), 1e-9);
        EXPECT_EQ(polyp.data.shape, s.colon.polyps[n].shape);
        ASSERT_GT(fieldAt(s.lumen, polyp.head), 0) << "its head is flesh";
        EXPECT_NEAR(wallAlong(s.lumen, polyp.head, polyp.inward, 10), polyp.height, 0.7) << "its top";
        const glm::dvec3 u = anyAcross(polyp.inward), v = glm::cross(polyp.inward, u);
        double least = 100;
        for (int step = 0; step < 16; ++step) {
            const double angle = step * 0.3926990817;
            const double side = wallAlong(s.lumen, polyp.head, std::cos(angle) * u + std::sin(angle) * v, 12);
            if (side < 0) continue;  // where it leans against the wall or a fold
            least = std::min(least, side);
            ++wide;
        }
        if (polyp.data.shape == PolypShape::Flat) continue;  // lies in the wall
        EXPECT_NEAR(least, polyp.across, 0.7) << "its width";
    }
    EXPECT_GT(wide, 60);
}

}  // namespace
}  // namespace stereonav
