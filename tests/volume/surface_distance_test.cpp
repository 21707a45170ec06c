// Free distances against planes and spheres in closed form, and against points found on noisy surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <vector>

#include "engine/volume/open_distance.h"
#include "engine/volume/plain_volume_caster.h"
#include "engine/volume/surface_cells.h"
#include "test_volumes.h"

namespace stereonav {
namespace {

using test::greyVolume;
using test::Random;
using test::slantedFrame;

SurfaceCells cellsOf(const GreyVolume& volume, float isovalue, const MaskVolume* region = nullptr) {
    Progress progress;
    return findSurfaceCells(volume, {isovalue, isovalue, isovalue, region}, progress);
}

double faceDistance(const VolumeFrame& frame, const glm::dvec3& voxel) {
    const glm::dvec3 d = glm::min(voxel, glm::dvec3(frame.size - 1) - voxel) * frame.spacing;
    return std::min({d.x, d.y, d.z});
}

TEST(SurfaceDistance, OfAPlane) {
    // Exactly linear: the isosurface is a plane.
    const glm::dvec3 slope(30, -20, 25);
    const GreyVolume volume =
        greyVolume(slantedFrame({40, 44, 36}), [&](const glm::dvec3& v) { return glm::dot(slope, v) - 500; });
    const SurfaceCells cells = cellsOf(volume, 100.5f);
    const glm::dvec3 gradient = slope / volume.frame.spacing;  // a metre
    Random random(1);
    int compared = 0;
    for (int n = 0; n < 3000; ++n) {
        const glm::dvec3 voxel = random.inBox(glm::dvec3(0), glm::dvec3(volume.frame.size - 1));
        const glm::dvec3 world = volume.frame.worldFromVoxel(voxel);
        const double truth = (600.5 - glm::dot(slope, voxel)) / glm::length(gradient);
        const double upTo = random.between(1e-3, 8e-3), tolerance = random.between(1e-5, 1e-3);
        const double free = freeDistance(cells, world, upTo, tolerance);
        const double faces = faceDistance(volume.frame, voxel);
        if (truth <= 0) {
            const bool known = -truth < std::min(upTo, faces) - 2e-3;
            EXPECT_EQ(free, known ? 0.0 : free) << n;
            continue;
        }
        ASSERT_LE(free, std::min({truth, upTo, faces}) + 1e-12) << n;
        // The foot of the perpendicular must lie in the volume for the closed form to hold.
        const glm::dvec3 foot = voxel + gradient / glm::length(gradient) * truth / volume.frame.spacing;
        if (faceDistance(volume.frame, foot) < 0) continue;
        ASSERT_GT(free, std::min({truth, upTo, faces}) - tolerance - 1e-12) << n;
        ++compared;
    }
    EXPECT_GT(compared, 500);
}

TEST(SurfaceDistance, InAHollowSphere) {
    const VolumeFrame frame = slantedFrame({64, 70, 50});
    const glm::dvec3 middle(31.5, 34.5, 24.5);
    const double radius = 0.018;
    const GreyVolume volume = greyVolume(frame, [&](const glm::dvec3& v) {
        return std::clamp(1e6 * (glm::length((v - middle) * frame.spacing) - radius), -30000.0, 30000.0);
    });
    const SurfaceCells cells = cellsOf(volume, 0.0f);
    Random random(2);
    // The trilinear surface leaves the sphere by at most h^2 / (8 r) an axis, below the limit taken.
    constexpr double kOff = 0.03e-3;
    for (int n = 0; n < 500; ++n) {
        const double r = random.between(0, 0.0175);
        const glm::dvec3 voxel = middle + random.direction() * r / frame.spacing;
        const double free = freeDistance(cells, frame.worldFromVoxel(voxel), 1.0, 0.02e-3);
        ASSERT_LE(free, radius - r + kOff) << n;
        ASSERT_GT(free, radius - r - kOff - 0.02e-3) << n;
        const glm::dvec3 behind = middle + random.direction() * (radius + 0.1e-3) / frame.spacing;
        ASSERT_EQ(freeDistance(cells, frame.worldFromVoxel(behind), 1.0, 0.02e-3), 0.0) << n;
    }
}

// Distance to the nearest of the points where the surface cuts an edge between voxels: finds specks that rays
// miss.
double edgeDistance(const GreyVolume& volume, double isovalue, const glm::dvec3& eye) {
    const VolumeFrame& frame = volume.frame;
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < static_cast<int>(frame.count()); ++n) {
        const glm::ivec3 a(n % frame.size.x, n / frame.size.x % frame.size.y,
                           n / (frame.size.x * frame.size.y));
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 b = a;
            if (++b[axis] >= frame.size[axis]) continue;
            const double va = volume.at(a) - isovalue, vb = volume.at(b) - isovalue;
            if ((va < 0) == (vb < 0)) continue;
            const glm::dvec3 cut = glm::dvec3(a) + glm::dvec3(b - a) * (va / (va - vb));
            least = std::min(least, glm::length(frame.worldFromVoxel(cut) - eye));
        }
    }
    return least;
}

// Points of the surface along many rays, by the plain caster.
std::vector<glm::dvec3> surfacePoints(const GreyVolume& volume, double isovalue, const glm::dvec3& eye,
                                      int count, Random& random) {
    std::vector<glm::dvec3> points;
    for (int n = 0; n < count; ++n) {
        const PlainRay ray{eye, random.direction(), 0};
        const PlainHit hit = castPlainVolume(volume, isovalue, ray);
        if (hit.hit()) points.push_back(volume.frame.worldFromVoxel(hit.voxel()));
    }
    return points;
}

TEST(SurfaceDistance, IsAboveNoPointSeenAndNearlyAttained) {
    Random random(3);
    const GreyVolume volume = greyVolume(slantedFrame({20, 22, 18}), [&](const glm::dvec3& v) {
        return 120 * glm::length(v - glm::dvec3(9.5, 10.5, 8.5)) - 700 + random.between(-400, 400);
    });
    const SurfaceCells cells = cellsOf(volume, 0.0f);
    int compared = 0;
    for (int n = 0; n < 40; ++n) {
        const glm::dvec3 voxel = random.inBox({5, 5, 5}, {14, 15, 12});
        const glm::dvec3 eye = volume.frame.worldFromVoxel(voxel);
        const double upTo = 0.02, tolerance = 1e-5;
        const double free = freeDistance(cells, eye, upTo, tolerance);
        if (plainValue(volume, voxel) >= 0) {
            ASSERT_EQ(free, 0.0) << n;
            continue;
        }
        ASSERT_GT(free, 0.0) << n;
        double least = std::min(faceDistance(volume.frame, voxel), edgeDistance(volume, 0, eye));
        for (const glm::dvec3& p : surfacePoints(volume, 0, eye, 20000, random))
            least = std::min(least, glm::length(p - eye));
        ASSERT_LE(free, least + 1e-12) << n;
        ASSERT_GT(free, least * 0.95 - tolerance) << n;  // the nearest of 20,000 rays is not the nearest
        ++compared;
    }
    EXPECT_GT(compared, 15);
}

// Brute force: every cell is cut into 16^3 boxes; of those with corners on both sides, which hold surface,
// the nearest is taken. The distance lies between its nearest point and its farthest.
struct Bracket {
    double least = std::numeric_limits<double>::infinity(), most = least;
};

void addCell(const GreyVolume& volume, double isovalue, const glm::ivec3& cell, const glm::dvec3& eye,
             Bracket& bracket) {
    constexpr int kCuts = 16;
    double v[8];
    bool below = false, above = false;
    for (int n = 0; n < 8; ++n) {
        v[n] = volume.at(cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2)) - isovalue;
        (v[n] < 0 ? below : above) = true;
    }
    if (!below || !above) return;
    const glm::dvec3 s = volume.frame.spacing;
    const auto value = [&](const glm::ivec3& at) {
        const glm::dvec3 f = glm::dvec3(at) / static_cast<double>(kCuts), g = 1.0 - f;
        return g.z * (g.y * (g.x * v[0] + f.x * v[1]) + f.y * (g.x * v[2] + f.x * v[3])) +
               f.z * (g.y * (g.x * v[4] + f.x * v[5]) + f.y * (g.x * v[6] + f.x * v[7]));
    };
    std::vector<char> sign(17 * 17 * 17);
    for (int n = 0; n < 17 * 17 * 17; ++n) sign[n] = value({n % 17, n / 17 % 17, n / 289}) < 0;
    for (int n = 0; n < kCuts * kCuts * kCuts; ++n) {
        const glm::ivec3 at(n % kCuts, n / kCuts % kCuts, n / (kCuts * kCuts));
        int count = 0;
        for (int c = 0; c < 8; ++c)
            count += sign[static_cast<std::size_t>(((at.z + (c >> 2)) * 17 + at.y + (c >> 1 & 1)) * 17 +
                                                   at.x + (c & 1))];
        if (count == 0 || count == 8) continue;
        const glm::dvec3 low = (glm::dvec3(cell) + glm::dvec3(at) / 16.0 - eye) * s, high = low + s / 16.0;
        bracket.least = std::min(bracket.least, glm::length(glm::clamp(glm::dvec3(0), low, high)));
        bracket.most = std::min(bracket.most, glm::length(glm::max(glm::abs(low), glm::abs(high))));
    }
}

// The nearest cells first: those that begin behind the farthest end of the bracket cannot narrow it.
Bracket bruteForce(const GreyVolume& volume, double isovalue, const glm::dvec3& voxel) {
    struct FarCell {
        double gap;  // metres from the eye to its nearest point
        glm::ivec3 cell;
    };
    std::vector<FarCell> cells;
    for (int k = 0; k < volume.frame.size.z - 1; ++k)
        for (int j = 0; j < volume.frame.size.y - 1; ++j)
            for (int i = 0; i < volume.frame.size.x - 1; ++i) {
                const glm::dvec3 low(i, j, k);
                const glm::dvec3 gap = glm::max(glm::max(low - voxel, voxel - (low + 1.0)), 0.0);
                cells.push_back({glm::length(gap * volume.frame.spacing), {i, j, k}});
            }
    std::sort(cells.begin(), cells.end(), [](const FarCell& a, const FarCell& b) { return a.gap < b.gap; });
    Bracket bracket;
    for (const FarCell& far : cells) {
        if (far.gap > bracket.most) break;
        addCell(volume, isovalue, far.cell, voxel, bracket);
    }
    return bracket;
}

// A rough wall around a lumen, isovalues on and between the stored numbers, tolerances from far below a cell
// to many cells: never above the distance, never further below it than the tolerance, never 0 in the lumen.
TEST(SurfaceDistance, KeepsItsBoundsAgainstBruteForceAtAnyTolerance) {
    Random random(6);
    int compared = 0, coarse = 0;
    for (int round = 0; round < 12; ++round) {
        const double rough = round % 3 * 200.0, steep = round % 2 ? 120 : 15;
        const glm::dvec3 spacing =
            round % 4 == 3 ? glm::dvec3(0.3e-3, 0.3e-3, 3e-3) : glm::dvec3(0.8e-3, 0.7e-3, 1.1e-3);
        const GreyVolume volume = greyVolume(slantedFrame({18, 17, 16}, spacing), [&](const glm::dvec3& v) {
            return steep * (glm::length(v - glm::dvec3(8.5, 8, 7.5)) - 6) + random.between(-rough, rough);
        });
        const float isovalue = round % 2 ? 0.0f : 0.5f;
        const SurfaceCells cells = cellsOf(volume, isovalue);
        for (int n = 0; n < 60; ++n) {
            const glm::dvec3 voxel = random.inBox(glm::dvec3(2), glm::dvec3(volume.frame.size - 3));
            const double value = plainValue(volume, voxel) - isovalue;
            const double tolerance = std::pow(10.0, random.between(-7, -2)),
                         upTo = random.between(0.2e-3, 10e-3);
            const double free = freeDistance(cells, volume.frame.worldFromVoxel(voxel), upTo, tolerance);
            SCOPED_TRACE(testing::Message()
                         << "round " << round << " point " << n << " tolerance " << tolerance);
            if (value >= 0) continue;  // in flesh 0 is promised near the surface alone
            const double within = std::min(upTo, faceDistance(volume.frame, voxel));
            const Bracket truth = bruteForce(volume, isovalue, voxel);
            ASSERT_GT(free, 0);
            ASSERT_LE(free, std::min(truth.most, within) + 1e-12);
            ASSERT_GT(free, std::min(truth.least, within) - tolerance - 1e-12);
            ++compared;
            coarse += tolerance > truth.most;
        }
    }
    EXPECT_GT(compared, 200);
    EXPECT_GT(coarse, 20);
}

TEST(SurfaceDistance, OutsideTheVolumeAndTheRegionThereIsNone) {
    const VolumeFrame frame = slantedFrame({40, 20, 20});
    const GreyVolume volume = greyVolume(frame, [](const glm::dvec3& v) { return 10 * v.x - 300; });
    MaskVolume region(frame);
    for (int k = 0; k < 20; ++k)
        for (int j = 0; j < 20; ++j)
            for (int i = 5; i < 35; ++i) region.at(i, j, k) = 1;
    const SurfaceCells cells = cellsOf(volume, 5.0f, &region);
    const auto free = [&](const glm::dvec3& voxel) {
        return freeDistance(cells, frame.worldFromVoxel(voxel), 4e-3, 1e-5);
    };
    EXPECT_GT(free({20, 10, 10}), 3.9e-3);
    EXPECT_NEAR(free({28, 10, 10}), 2.5 * 0.8e-3, 1e-5);
    EXPECT_EQ(free({2.5, 10, 10}), 0.0);   // not in the region
    EXPECT_EQ(free({-0.1, 10, 10}), 0.0);  // nor in the volume
    EXPECT_EQ(free({20, 19.1, 10}), 0.0);
    EXPECT_EQ(free({30.6, 10, 10}), 0.0);
    EXPECT_EQ(free({std::numeric_limits<double>::quiet_NaN(), 10, 10}), 0.0);
    EXPECT_EQ(freeDistance(cells, frame.worldFromVoxel({20, 10, 10}), 0.0, 1e-5), 0.0);
    EXPECT_EQ(freeDistance(SurfaceCells(), {0, 0, 0}, 1.0, 1e-5), 0.0);
}

// A ball, whose distance is known in the volume and beyond its faces.
TEST(OpenDistance, IsThatOfABallInTheBoxAndABoundBeyondIt) {
    const VolumeFrame frame = slantedFrame({40, 44, 34});
    const glm::dvec3 middle(19.5, 21.5, 16.5), last(frame.size - 1);
    constexpr double kRadius = 0.008, kTolerance = 0.02e-3;
    constexpr double kOff = 0.04e-3;  // metres from the ball to the trilinear surface: h^2 / (8 r) an axis
    const GreyVolume volume = greyVolume(frame, [&](const glm::dvec3& v) {
        return std::clamp(1e6 * (kRadius - glm::length((v - middle) * frame.spacing)), -30000.0, 30000.0);
    });
    const SurfaceCells cells = cellsOf(volume, 0.0f);
    Random random(8);
    int inside = 0, beyond = 0, behind = 0;
    for (int n = 0; n < 800; ++n) {
        const glm::dvec3 voxel = random.inBox(-0.5 * last, 1.5 * last);
        const double truth = glm::length((voxel - middle) * frame.spacing) - kRadius;
        const double free = openDistance(cells, frame.worldFromVoxel(voxel), 1.0, kTolerance);
        ASSERT_LE(free, std::max(truth, 0.0) + kOff) << n;
        const glm::dvec3 nearest = glm::clamp(voxel, glm::dvec3(0), last);
        const double away = glm::length((voxel - nearest) * frame.spacing);
        if (truth <= 0) {
            behind += truth < -kOff;
            ASSERT_EQ(free, truth < -kOff ? 0.0 : free) << n;
        } else if (away > 0) {
            const double there = glm::length((nearest - middle) * frame.spacing) - kRadius;
            ASSERT_GT(free, std::hypot(away, there - kOff - kTolerance) - 1e-12) << n;
            ++beyond;
        } else {
            ASSERT_GT(free, truth - kOff - kTolerance) << n;
            inside += truth > faceDistance(frame, voxel) + kOff;  // faces do not count
        }
        const double upTo = random.between(1e-6, 0.02);
        ASSERT_LE(openDistance(cells, frame.worldFromVoxel(voxel), upTo, kTolerance), upTo) << n;
    }
    EXPECT_GT(inside, 10);
    EXPECT_GT(beyond, 400);
    EXPECT_GT(behind, 1);
}

TEST(OpenDistance, HasNoStepAtTheFacesAndNoAnswerWithoutAPlace) {
    const VolumeFrame frame = slantedFrame({20, 22, 18});
    const GreyVolume volume = greyVolume(frame, [](const glm::dvec3& v) { return 40 * (12 - v.x); });
    const SurfaceCells cells = cellsOf(volume, 0.0f);
    Random random(9);
    for (int n = 0; n < 200; ++n) {
        glm::dvec3 voxel = random.inBox({13, 0, 0}, glm::dvec3(frame.size - 1));
        voxel.x = 19 - 1e-9;
        const double before = openDistance(cells, frame.worldFromVoxel(voxel), 1.0, 1e-6);
        voxel.x = 19 + 1e-9;
        ASSERT_NEAR(openDistance(cells, frame.worldFromVoxel(voxel), 1.0, 1e-6), before, 1.1e-6) << n;
        ASSERT_NEAR(before, 7 * frame.spacing.x, 2e-6) << n;
    }
    // A volume that is cut at a face: there is no way in.
    EXPECT_LT(openDistance(cells, frame.worldFromVoxel({0, 10, 9}), 1.0, 1e-6),
              1e-15);  // rounding of the place
    EXPECT_NEAR(openDistance(cells, frame.worldFromVoxel({-4, 10, 9}), 1.0, 1e-6), 4 * frame.spacing.x, 1e-9);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(openDistance(cells, {nan, 0, 0}, 1.0, 1e-6), 0.0);
    EXPECT_EQ(openDistance(cells, frame.worldFromVoxel({15, 10, 9}), 0.0, 1e-6), 0.0);
    EXPECT_EQ(openDistance(SurfaceCells(), {0, 0, 0}, 1.0, 1e-6), 0.0);
}

TEST(SurfaceDistance, FallsByNoMoreThanTheWay) {
    Random random(4);
    const GreyVolume volume = greyVolume(slantedFrame({30, 30, 30}), [&](const glm::dvec3& v) {
        return 100 * glm::length(v - glm::dvec3(14.5)) - 1000 + random.between(-300, 300);
    });
    const SurfaceCells cells = cellsOf(volume, 0.0f);
    const double tolerance = 1e-5;
    int compared = 0;
    for (int n = 0; n < 3000; ++n) {
        const glm::dvec3 a = volume.frame.worldFromVoxel(random.inBox(glm::dvec3(4), glm::dvec3(25)));
        if (plainValue(volume, volume.frame.voxelFromWorld(a)) >= 0) continue;
        const glm::dvec3 b = a + random.direction() * random.between(0, 1e-3);
        const double way = glm::length(b - a);
        const double freeA = freeDistance(cells, a, 1, tolerance),
                     freeB = freeDistance(cells, b, 1, tolerance);
        ASSERT_LE(freeA - freeB, way + tolerance + 1e-12) << n;
        ++compared;
    }
    EXPECT_GT(compared, 500);
}

// In the processor time of this process, against one look at each cell, which is what the search has to
// spare.
TEST(SurfaceDistance, TakesLittleTime) {
    const VolumeFrame frame = slantedFrame({110, 120, 90});
    const glm::dvec3 middle = glm::dvec3(frame.size - 1) * 0.5;
    const GreyVolume volume = greyVolume(frame, [&](const glm::dvec3& v) {
        return std::clamp(1e6 * (glm::length((v - middle) * frame.spacing) - 0.035), -30000.0, 30000.0);
    });
    const SurfaceCells cells = cellsOf(volume, 0.0f);
    Random random(5);
    const auto used = [] { return 1e6 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    const auto microseconds = [&](double low, double high, double upTo) {
        constexpr int kCount = 1000;
        double sum = 0;
        const double start = used();
        for (int n = 0; n < kCount; ++n) {
            const glm::dvec3 v = middle + random.direction() * random.between(low, high) / frame.spacing;
            sum += freeDistance(cells, frame.worldFromVoxel(v), upTo, 0.05e-3);
        }
        EXPECT_GT(sum, 0);
        return (used() - start) / kCount;
    };
    const double open = microseconds(0, 0.02, 0.01), wall = microseconds(0.031, 0.0345, 0.01);
    const double start = used();
    int holding = 0;
    for (int k = 0; k + 1 < frame.size.z; ++k)
        for (int j = 0; j + 1 < frame.size.y; ++j)
            for (int i = 0; i + 1 < frame.size.x; ++i) {
                int below = 0;
                for (int n = 0; n < 8; ++n)
                    below += volume.at(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)) < 0;
                holding += below > 0 && below < 8;
            }
    const double each = used() - start;
    EXPECT_GT(holding, 1000);
    std::printf("free distance: %.2f us in the open, %.2f at 0.5 to 4 mm from the wall; all cells: %.0f us\n",
                open, wall, each);
    EXPECT_LT(open, each / 20);
    EXPECT_LT(wall, each / 5);
}

}  // namespace
}  // namespace stereonav
