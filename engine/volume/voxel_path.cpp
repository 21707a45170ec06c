// The graph of a mask's voxels, and shortest paths in it by a circular queue of buckets.
#include "engine/volume/voxel_path.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/pages.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr BlockPieces piecesOf(int pattern) {
    BlockPieces pieces;
    int done = 0;
    for (int seed = 0; seed < 8; ++seed) {
        if (!(pattern >> seed & 1) || (done >> seed & 1)) continue;
        int piece = 1 << seed, before = 0;
        while (piece != before) {
            before = piece;
            for (int n = 0; n < 8; ++n)
                for (int axis = 1; axis < 8; axis *= 2)
                    if ((pattern >> n & 1) && (before >> (n ^ axis) & 1)) piece |= 1 << n;
        }
        for (int n = 0; n < 8; ++n)
            if (piece >> n & 1) pieces.piece[n] = pieces.count;
        ++pieces.count;
        done |= piece;
    }
    return pieces;
}

constexpr std::array<BlockPieces, 256> allPieces() {
    std::array<BlockPieces, 256> all{};
    for (int pattern = 0; pattern < 256; ++pattern) all[pattern] = piecesOf(pattern);
    return all;
}

constexpr std::array<BlockPieces, 256> kPieces = allPieces();

// Calls visit(index) for the bytes in [begin, end) that are not zero.
template <typename Visit>
void forEachNonzero(const std::uint8_t* bytes, std::size_t begin, std::size_t end, const Visit& visit) {
    for (std::size_t at = begin; at < end;) {
        std::uint64_t eight = 0;
        if (at + 8 <= end) {
            std::memcpy(&eight, bytes + at, 8);
            if (eight == 0) {
                at += 8;
                continue;
            }
        }
        for (const std::size_t stop = std::min(at + 8, end); at < stop; ++at)
            if (bytes[at]) visit(at);
    }
}

}  // namespace

const BlockPieces& blockPieces(std::uint8_t pattern) {
    return kPieces[pattern];
}

VoxelGraph::VoxelGraph(const MaskVolume& mask, std::uint8_t label, const glm::ivec3& first,
                       const glm::ivec3& last, const glm::ivec3& block)
    : mFirst(glm::max(first, glm::ivec3(0))),
      mLast(glm::min(last, mask.frame.size - 1)),
      mBlock(glm::clamp(block, glm::ivec3(1), glm::ivec3(2))) {
    mLast = glm::max(mLast, mFirst - 1);
    mGrid = (mLast - mFirst + mBlock) / mBlock + 2;
    mFull = 0;
    for (int n = 0; n < 8; ++n)
        if ((n & 1) < mBlock.x && (n >> 1 & 1) < mBlock.y && n >> 2 < mBlock.z) mFull |= 1 << n;
    const std::size_t blocks = static_cast<std::size_t>(mGrid.x) * mGrid.y * mGrid.z;
    if (blocks > std::numeric_limits<std::uint32_t>::max())
        throw Error("", "", "the lumen has too many voxels to find a path in", "crop or resample the study");
    makeSteps(mask.frame.spacing);
    gatherPatterns(mask, label);
    numberNodes();
}

void VoxelGraph::makeSteps(const glm::dvec3& spacing) {
    const glm::dvec3 size = spacing * glm::dvec3(mBlock);
    const auto numberOf = [&](const glm::ivec3& by) {
        for (int n = 0; n < kSteps; ++n)
            if (mSteps[n].by == by) return n;
        return -1;
    };
    int count = 0;
    for (int axes = 1; axes <= 3; ++axes)  // faces, edges, corners
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 by(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            if (std::abs(by.x) + std::abs(by.y) + std::abs(by.z) == axes) mSteps[count++].by = by;
        }
    for (int n = 0; n < kSteps; ++n) {
        const glm::ivec3 by = mSteps[n].by;
        for (int part = 1; part < 8; ++part) {
            const int other = numberOf(by * glm::ivec3(part & 1, part >> 1 & 1, part >> 2));
            if (other >= 0) mSteps[n].needs |= 1u << other;
        }
        mSteps[n].offset = (static_cast<std::ptrdiff_t>(by.z) * mGrid.y + by.y) * mGrid.x + by.x;
        mLengths[n] = glm::length(size * glm::dvec3(by));
    }
    mShortest = *std::min_element(mLengths.begin(), mLengths.end());
    mLongest = *std::max_element(mLengths.begin(), mLengths.end());
    for (int face = 0; face < kFaces; ++face) {
        const glm::ivec3 by = mSteps[face].by;
        const int axis = by.x ? 0 : by.y ? 1 : 2, high = (mBlock[axis] - 1) << axis;
        for (int n = 0; n < 8; ++n)
            if ((mFull >> n & 1) && (n >> axis & 1) == 0) {
                const auto low = static_cast<std::uint8_t>(n), top = static_cast<std::uint8_t>(n | high);
                mFacePairs[face].push_back(by[axis] > 0 ? std::array{top, low} : std::array{low, top});
            }
    }
}

void VoxelGraph::gatherPatterns(const MaskVolume& mask, std::uint8_t label) {
    mPatterns = LazyArray<std::uint8_t>(static_cast<std::size_t>(mGrid.x) * mGrid.y * mGrid.z);
    const auto width = static_cast<std::size_t>(mLast.x) - mFirst.x + 1;
    const auto gatherRow = [&](int y, int z) {
        const std::uint8_t* row = mask.values.data() + mask.frame.index(mFirst.x, mFirst.y + y, mFirst.z + z);
        std::uint8_t* patterns =
            mPatterns.data() + 1 +
            (static_cast<std::size_t>(z / mBlock.z + 1) * mGrid.y + (y / mBlock.y + 1)) * mGrid.x;
        const int inRow = (y % mBlock.y) << 1 | (z % mBlock.z) << 2, halve = mBlock.x - 1;
        forEachNonzero(row, 0, width, [&](std::size_t x) {
            if (row[x] == label) patterns[x >> halve] |= 1 << (inRow | (x & halve));
        });
    };
    parallelFor(mGrid.z - 2, [&](int slab) {
        const int end = std::min((slab + 1) * mBlock.z, mLast.z - mFirst.z + 1);
        for (int z = slab * mBlock.z; z < end; ++z)
            for (int y = 0; y <= mLast.y - mFirst.y; ++y) gatherRow(y, z);
        if (end > slab * mBlock.z) {
            const std::size_t from = mask.frame.index(0, 0, mFirst.z + slab * mBlock.z);
            releaseZeroPages(mask.values, from, mask.frame.index(0, 0, mFirst.z + end) - from);
        }
    });
}

void VoxelGraph::numberNodes() {
    const std::size_t slab = static_cast<std::size_t>(mGrid.x) * mGrid.y;
    std::vector<std::size_t> firstOf(mGrid.z + 1, 0);
    parallelFor(mGrid.z, [&](int z) {
        std::size_t count = 0;
        forEachNonzero(mPatterns.data(), z * slab, (z + 1) * slab,
                       [&](std::size_t cell) { count += kPieces[mPatterns[cell]].count; });
        firstOf[z + 1] = count;
        releaseZeroPages(mPatterns, z * slab, slab);
    });
    for (int z = 0; z < mGrid.z; ++z) firstOf[z + 1] += firstOf[z];
    if (firstOf.back() >= std::numeric_limits<Node>::max() - 1)
        throw Error("", "", "the lumen has too many voxels to find a path in", "crop or resample the study");
    mFirstNode = LazyArray<Node>(mPatterns.size());
    mCells.resize(firstOf.back());
    mParts.resize(firstOf.back());
    parallelFor(mGrid.z, [&](int z) {
        std::size_t node = firstOf[z];
        forEachNonzero(mPatterns.data(), z * slab, (z + 1) * slab, [&](std::size_t cell) {
            mFirstNode[cell] = static_cast<Node>(node + 1);
            for (std::uint8_t part = 0; part < kPieces[mPatterns[cell]].count; ++part, ++node) {
                mCells[node] = static_cast<std::uint32_t>(cell);
                mParts[node] = part;
            }
        });
        releaseZeroPages(mPatterns, z * slab, slab);
    });
}

glm::ivec3 VoxelGraph::blockVoxel(Node node) const {
    const std::uint32_t cell = mCells[node], row = cell / mGrid.x;
    const glm::ivec3 at(static_cast<int>(cell % mGrid.x), static_cast<int>(row % mGrid.y),
                        static_cast<int>(row / mGrid.y));
    return mFirst + (at - 1) * mBlock;
}

std::vector<VoxelGraph::Node> VoxelPaths::to(VoxelGraph::Node end) const {
    std::vector<VoxelGraph::Node> path;
    if (end >= ways.size() || !std::isfinite(ways[end].cost)) return path;
    for (VoxelGraph::Node n = end; n != kNone; n = ways[n].previous) path.push_back(n);
    std::reverse(path.begin(), path.end());
    return path;
}

namespace {

// Nodes by cost, in buckets around a ring. A bucket is as wide as the cheapest step, so what is taken
// from the lowest one is settled; where that would need more than kMost buckets they are wider, and a node
// may be taken again at a lower cost.
class BucketQueue {
public:
    struct Entry {
        float cost;
        VoxelGraph::Node node;
    };
    BucketQueue(double cheapestStep, double dearestStep)
        : mWidth(std::max(cheapestStep, dearestStep / kMost)),
          mRing(static_cast<std::size_t>(dearestStep / mWidth) + 3) {}

    void push(float cost, VoxelGraph::Node node) {
        mRing[std::max(static_cast<std::size_t>(cost / mWidth), mLowest) % mRing.size()].push_back(
            {cost, node});
        ++mCount;
    }
    double width() const { return mWidth; }
    bool pop(Entry& entry) {
        if (mCount == 0) return false;
        // Memory of buckets that are done is for those to come.
        for (; mRing[mLowest % mRing.size()].empty(); ++mLowest)
            std::vector<Entry>().swap(mRing[mLowest % mRing.size()]);
        std::vector<Entry>& bucket = mRing[mLowest % mRing.size()];
        entry = bucket.back();
        bucket.pop_back();
        --mCount;
        return true;
    }

private:
    static constexpr double kMost = 65536;
    double mWidth;
    std::vector<std::vector<Entry>> mRing;
    std::size_t mLowest = 0, mCount = 0;
};

}  // namespace

VoxelPaths findVoxelPaths(const VoxelGraph& graph, std::vector<float> weights, VoxelGraph::Node start,
                          VoxelGraph::Node end, const std::function<void()>& poll) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    VoxelPaths paths;
    paths.ways.assign(graph.nodeCount(), {kFar, kFar, 1.0f, VoxelPaths::kNone});
    if (start >= graph.nodeCount()) return paths;
    float dearest = 1;
    for (std::size_t n = 0; n < weights.size(); ++n) {
        paths.ways[n].weight = std::clamp(weights[n], 1.0f, kLargestWeight);
        dearest = std::max(dearest, paths.ways[n].weight);
    }
    weights = {};
    BucketQueue queue(graph.shortestStep(), graph.longestStep() * dearest);
    paths.ways[start].cost = paths.ways[start].length = 0;
    queue.push(0, start);
    std::size_t taken = 0;
    for (BucketQueue::Entry entry{}; queue.pop(entry);) {
        const VoxelPaths::Way from = paths.ways[entry.node];
        if (entry.cost > from.cost) continue;
        if (++taken % 262144 == 0) poll();
        // What is still queued costs at least the lower end of this bucket.
        if (end < graph.nodeCount() && paths.ways[end].cost <= entry.cost - queue.width()) break;
        graph.forEachNeighbour(entry.node, [&](VoxelGraph::Node next, int step) {
            VoxelPaths::Way& to = paths.ways[next];
            const auto length = static_cast<float>(graph.stepLength(step));
            const float cost = entry.cost + 0.5f * (from.weight + to.weight) * length;
            if (!(cost < to.cost)) return;
            to = {cost, from.length + length, to.weight, entry.node};
            queue.push(cost, next);
        });
    }
    float longest = -1;
    for (std::size_t n = 0; n < paths.ways.size(); ++n)
        if (std::isfinite(paths.ways[n].length) && paths.ways[n].length > longest) {
            longest = paths.ways[n].length;
            paths.farthest = static_cast<VoxelGraph::Node>(n);
        }
    return paths;
}

}  // namespace stereonav
