// Outlines in planes of voxel centres are closed polygons, and each crossing is a corner of two. A corner's
// height h over the line between its neighbours, at distances l and r, is l r / 2 times the curvature:
// exactly, for circles. Corners go to the height that the mean curvature of those around asks for. A mean
// curvature of 0 in its place would make minimal surfaces, as antialiasing of binary volumes by level sets
// does (Whitaker 2000): those shrink until voxel centres hold them, and have stairs of another kind there.
// The mean goes on from round to round, a part of it renewed in each, so that a few averages a round make a
// wide one.
#include "colon/segmentation/wall_relaxation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Share of its way that a crossing goes in a round: with 1 outlines may swing.
constexpr float kStep = 0.6f;
// Times that the mean bends are averaged with those of their neighbours, in a round.
constexpr int kPasses = 2;
// Rounds of keeping the volume, of which the first does nearly all.
constexpr int kVolumeRounds = 3;
// Part of a normal along a crossing's line: less counts as this where the whole wall moves.
constexpr float kSteepest = 0.3f;

// How an outline bends at a corner; bends of several corners are added.
struct Bend {
    float height = 0;  // outwards, over the line between the neighbours
    float weight = 0;  // that height for a curvature of 1: half the product of the neighbours' distances

    void goTo(const Bend& other, float share) {
        height += share * (other.height - height);
        weight += share * (other.weight - weight);
    }
};
struct CornerBend : Bend {
    float lean = 0;  // way along the crossing's own line for a height of 1
};

float lengthOf(float x, float y) {
    return std::sqrt(x * x + y * y);
}

class WallRelaxer {
public:
    WallRelaxer(WallCrossings& wall, const CrossingLinks& links, const glm::dvec3& spacing)
        : mWall(wall),
          mLinks(links),
          mSpacing(glm::vec3(spacing / std::min({spacing.x, spacing.y, spacing.z}))),
          mAxes(wall.count()) {
        forCrossings(wall, 0, (wall.start.size() - 1) / 3, [&](int axis, const glm::ivec3&, std::uint32_t n) {
            mAxes[n] = static_cast<std::uint8_t>(axis);
        });
    }

    void run(const WallRelaxation& setting, Progress& progress) {
        mMargin = static_cast<float>(setting.margin);
        const int rounds = std::max(setting.rounds, 0);
        ProgressSteps steps(progress, static_cast<std::size_t>(rounds) + 1, "smoothing the wall");
        takeMemory();
        for (int round = 0; round < rounds; ++round) {
            if (progress.cancelled()) throw Cancelled();
            const float share = round == 0 ? 1.0f : static_cast<float>(setting.share);
            forAll([&](std::uint32_t n) {
                mBends[n] = {bendOf(n, 0), bendOf(n, 1)};
                for (int plane = 0; plane < 2; ++plane) mMean[n][plane].goTo(mBends[n][plane], share);
            });
            for (int pass = 0; pass < kPasses; ++pass) {
                forAll([&](std::uint32_t n) { mOther[n] = {meanOf(n, 0), meanOf(n, 1)}; });
                mMean.swap(mOther);
            }
            forAll([&](std::uint32_t n) { mNext[n] = moved(n); });
            mWall.at.swap(mNext);
            steps.done();
        }
        for (int round = 0; round < kVolumeRounds; ++round) keepVolume();
        steps.done();
    }

    std::vector<glm::vec3> normals() const {
        std::vector<glm::vec3> normals(mWall.count());
        forAll([&](std::uint32_t n) { normals[n] = normalOf(n); });
        return normals;
    }

private:
    // In the plane of an outline, from the crossing's lower voxel.
    struct Place {
        float along = 0, across = 0;
    };
    struct Gain {
        double volume = 0, perWay = 0;  // voxels, and voxels for a way of 1 outwards
    };
    static constexpr std::size_t kBlock = 8192;

    void takeMemory() {
        mBends.resize(mWall.count());
        mMean.resize(mWall.count());
        mOther.resize(mWall.count());
        mNext.resize(mWall.count());
    }

    template <typename Use>
    void forBlocks(const Use& use) const {
        const std::size_t count = mWall.count();
        parallelFor(static_cast<int>((count + kBlock - 1) / kBlock), [&](int block) {
            const std::size_t first = static_cast<std::size_t>(block) * kBlock;
            use(block, static_cast<std::uint32_t>(first),
                static_cast<std::uint32_t>(std::min(first + kBlock, count)));
        });
    }
    template <typename Use>
    void forAll(const Use& use) const {
        forBlocks([&](int, std::uint32_t first, std::uint32_t end) {
            for (std::uint32_t n = first; n < end; ++n) use(n);
        });
    }

    float outwards(std::uint32_t n) const { return mWall.leaves[n] ? 1.0f : -1.0f; }
    float spacingOf(std::uint32_t n) const { return mSpacing[mAxes[n]]; }

    Place placeOf(std::uint32_t n, int plane, int side) const {
        const CrossingLink link = mLinks[n][2 * plane + side];
        const float a = spacingOf(n), b = mSpacing[(mAxes[n] + 1 + plane) % 3],
                    at = mWall.at[link.crossing()];
        if (link.line() == CrossingLink::Beside) return {at * a, side ? b : -b};
        return {link.line() == CrossingLink::AtUpper ? a : 0.0f, (side ? at : at - 1) * b};
    }
    bool linked(std::uint32_t n, int plane) const {
        return !mLinks[n][2 * plane].none() && !mLinks[n][2 * plane + 1].none();
    }

    CornerBend bendOf(std::uint32_t n, int plane) const {
        if (!linked(n, plane)) return {};
        const Place low = placeOf(n, plane, 0), high = placeOf(n, plane, 1);
        const float width = high.across - low.across, rise = high.along - low.along;
        const float lean = lengthOf(width, rise) / width, own = mWall.at[n] * spacingOf(n);
        const float over = own - (low.along - low.across * rise / width);
        CornerBend bend;
        bend.height = outwards(n) * over / lean;
        bend.weight = 0.5f * lengthOf(own - low.along, low.across) * lengthOf(own - high.along, high.across);
        bend.lean = lean;
        return bend;
    }

    // The corner's bend and those of its neighbours, as 2 to 1 to 1.
    Bend meanOf(std::uint32_t n, int plane) const {
        const Bend& own = mMean[n][plane];
        Bend sum{2 * own.height, 2 * own.weight};
        for (int side = 0; side < 2; ++side) {
            const CrossingLink link = mLinks[n][2 * plane + side];
            if (link.none()) continue;
            // The plane of two axes is the first of the planes of one of them, and the second of the other's.
            const Bend& next =
                mMean[link.crossing()][link.line() == CrossingLink::Beside ? plane : 1 - plane];
            sum.height += next.height;
            sum.weight += next.weight;
        }
        return {0.25f * sum.height, 0.25f * sum.weight};
    }

    float moved(std::uint32_t n) const {
        float way = 0;
        int planes = 0;
        for (int plane = 0; plane < 2; ++plane) {
            const CornerBend& bend = mBends[n][plane];
            const Bend& mean = mMean[n][plane];
            if (!linked(n, plane) || !(mean.weight > 0)) continue;
            way += (mean.height / mean.weight * bend.weight - bend.height) * bend.lean;
            ++planes;
        }
        if (planes == 0) return mWall.at[n];
        return kept(mWall.at[n] + kStep * outwards(n) * way / (static_cast<float>(planes) * spacingOf(n)));
    }
    float kept(float at) const { return std::clamp(at, mMargin, 1 - mMargin); }

    glm::vec3 normalOf(std::uint32_t n) const {
        glm::vec3 normal(0.0f);
        normal[mAxes[n]] = 1;
        for (int plane = 0; plane < 2; ++plane) {
            if (!linked(n, plane)) continue;
            const Place low = placeOf(n, plane, 0), high = placeOf(n, plane, 1);
            normal[(mAxes[n] + 1 + plane) % 3] = -(high.along - low.along) / (high.across - low.across);
        }
        return outwards(n) * glm::normalize(normal);
    }

    // Moves the wall as a whole by what its volume lacks. Lines along each axis measure what a piece of wall
    // has gained; the squares of its normal's parts, whose sum is 1, weigh the three.
    void keepVolume() {
        const std::vector<glm::vec3> normal = normals();
        const auto facing = [&](std::uint32_t n) { return std::abs(normal[n][mAxes[n]]); };
        const Gain gain = sumAll([&](std::uint32_t n) {
            const float f = facing(n);
            return Gain{static_cast<double>(f * f * outwards(n) * (mWall.at[n] - 0.5f)),
                        static_cast<double>(f / spacingOf(n))};
        });
        if (!(gain.perWay > 0)) return;
        const auto way = static_cast<float>(-gain.volume / gain.perWay);
        forAll([&](std::uint32_t n) {
            mWall.at[n] =
                kept(mWall.at[n] + outwards(n) * way / (std::max(facing(n), kSteepest) * spacingOf(n)));
        });
    }

    // Sums blocks of a fixed size one after the other: the number of threads changes nothing.
    template <typename Of>
    Gain sumAll(const Of& of) const {
        std::vector<Gain> sums((mWall.count() + kBlock - 1) / kBlock);
        forBlocks([&](int block, std::uint32_t first, std::uint32_t end) {
            Gain& sum = sums[static_cast<std::size_t>(block)];
            for (std::uint32_t n = first; n < end; ++n) {
                const Gain one = of(n);
                sum = {sum.volume + one.volume, sum.perWay + one.perWay};
            }
        });
        Gain sum;
        for (const Gain& one : sums) sum = {sum.volume + one.volume, sum.perWay + one.perWay};
        return sum;
    }

    WallCrossings& mWall;
    const CrossingLinks& mLinks;
    glm::vec3 mSpacing;
    float mMargin = 0;
    std::vector<std::uint8_t> mAxes;
    std::vector<std::array<CornerBend, 2>> mBends;
    std::vector<std::array<Bend, 2>> mMean, mOther;
    std::vector<float> mNext;
};

}  // namespace

std::vector<glm::vec3> relaxWall(WallCrossings& wall, const CrossingLinks& links, const glm::dvec3& spacing,
                                 const WallRelaxation& setting, Progress& progress) {
    WallRelaxer relaxer(wall, links, spacing);
    relaxer.run(setting, progress);
    return relaxer.normals();
}

}  // namespace stereonav
