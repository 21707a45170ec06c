// Ways through pieces are walked on coarse blocks (Dijkstra 1959): a few thousand for a whole colon.
#include "colon/segmentation/lumen_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kLargestBlock = 8;   // voxels
constexpr int kBlocksAcross = 16;  // at least, along a piece's longest side, where it has as many voxels

int blockSize(const Component& part) {
    const glm::ivec3 extent = part.last - part.first + 1;
    return std::clamp(std::max({extent.x, extent.y, extent.z}) / kBlocksAcross, 1, kLargestBlock);
}

bool before(const glm::ivec3& a, const glm::ivec3& b) {
    return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
}

// The blocks that a piece touches, sorted.
std::vector<glm::ivec3> blocksOf(const Pieces& pieces, int piece, int size) {
    const Component& part = pieces.parts.list[static_cast<std::size_t>(piece)];
    std::vector<glm::ivec3> blocks;
    for (int k = part.first.z; k <= part.last.z; ++k)
        for (int j = part.first.y; j <= part.last.y; ++j) {
            const std::uint32_t first = pieces.runs.rowStart[pieces.runs.rowNumber(j, k)];
            const std::uint32_t end = pieces.runs.rowStart[pieces.runs.rowNumber(j, k) + 1];
            for (std::uint32_t n = first; n < end; ++n) {
                if (pieces.parts.ofRun[n] != static_cast<std::uint32_t>(piece)) continue;
                const VoxelRun& run = pieces.runs.runs[n];
                for (int i = run.first / size; i <= (run.end - 1) / size; ++i)
                    blocks.push_back({i, j / size, k / size});
            }
        }
    std::sort(blocks.begin(), blocks.end(), before);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

class BlockGraph {
public:
    BlockGraph(std::vector<glm::ivec3> blocks, int blockSize, const VolumeFrame& frame)
        : mBlocks(std::move(blocks)), mBlockSize(blockSize), mFrame(frame) {}

    std::size_t size() const { return mBlocks.size(); }
    glm::dvec3 place(std::size_t n) const {
        return mFrame.worldFromVoxel(glm::dvec3(mBlocks[n] * mBlockSize) + 0.5 * (mBlockSize - 1));
    }

    struct Far {
        std::size_t block = 0;
        double way = 0;  // metres
    };
    // The block farthest from `start`, in steps to the 26 neighbours.
    Far farthestFrom(std::size_t start) const {
        using Open = std::pair<double, std::size_t>;  // way, block
        std::vector<double> way(mBlocks.size(), std::numeric_limits<double>::infinity());
        std::priority_queue<Open, std::vector<Open>, std::greater<>> queue;
        queue.push({0, start});
        way[start] = 0;
        Far far{start, 0};
        while (!queue.empty()) {
            const double walked = queue.top().first;
            const std::size_t n = queue.top().second;
            queue.pop();
            if (walked > way[n]) continue;
            if (walked > far.way) far = {n, walked};
            forNeighbours(n, [&](std::size_t next) {
                const double there = walked + glm::distance(place(n), place(next));
                if (there >= way[next]) return;
                way[next] = there;
                queue.push({there, next});
            });
        }
        return far;
    }

private:
    template <typename Body>
    void forNeighbours(std::size_t n, const Body& body) const {
        for (int step = 0; step < 27; ++step) {
            const glm::ivec3 to = mBlocks[n] + glm::ivec3(step % 3, step / 3 % 3, step / 9) - 1;
            const auto found = std::lower_bound(mBlocks.begin(), mBlocks.end(), to, before);
            if (step != 13 && found != mBlocks.end() && *found == to)
                body(static_cast<std::size_t>(found - mBlocks.begin()));
        }
    }
    std::vector<glm::ivec3> mBlocks;
    int mBlockSize;
    VolumeFrame mFrame;
};

// The rectum lies low and at the back (y grows to the back); a caecum may hang as low, but lies in front.
double height(const glm::dvec3& world) {
    return world.z - 0.5 * world.y;
}

}  // namespace

std::string givenName(const char* option, const glm::dvec3& place) {
    return fmt::format("{} {:.7g},{:.7g},{:.7g}", option, 1000 * place.x, 1000 * place.y, 1000 * place.z);
}

glm::ivec3 givenVoxel(const VolumeFrame& frame, const char* option, const glm::dvec3& place) {
    if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z))
        throw Error(givenName(option, place), "", "expected three finite numbers",
                    "give a place in millimetres");
    const glm::dvec3 voxel = glm::floor(frame.voxelFromWorld(place) + 0.5);
    const glm::dvec3 size(frame.size);
    if (voxel.x < 0 || voxel.y < 0 || voxel.z < 0 || voxel.x >= size.x || voxel.y >= size.y ||
        voxel.z >= size.z)
        throw Error(givenName(option, place), "",
                    fmt::format("lies outside the volume: voxel {:.0f} {:.0f} {:.0f} of {} x {} x {}",
                                voxel.x, voxel.y, voxel.z, frame.size.x, frame.size.y, frame.size.z),
                    "give a place inside it, in millimetres (x left, y back, z up)");
    return glm::ivec3(voxel);
}

PieceWay wayThrough(const Pieces& pieces, int piece, const VolumeFrame& frame) {
    const int size = blockSize(pieces.parts.list[static_cast<std::size_t>(piece)]);
    const BlockGraph graph(blocksOf(pieces, piece, size), size, frame);
    std::size_t lowest = 0;
    for (std::size_t n = 1; n < graph.size(); ++n)
        if (height(graph.place(n)) < height(graph.place(lowest))) lowest = n;
    const std::size_t one = graph.farthestFrom(lowest).block;
    const BlockGraph::Far other = graph.farthestFrom(one);
    PieceWay way;
    way.lowest = graph.place(lowest);
    way.fromLowest = graph.place(one);
    way.ends[0] = graph.place(other.block);
    way.ends[1] = graph.place(one);
    way.length = other.way;
    return way;
}

std::vector<int> orderOf(const Pieces& pieces, const std::vector<int>& kept, const VolumeFrame& frame) {
    if (kept.size() < 2) return kept;
    std::vector<std::pair<int, PieceWay>> rest;
    rest.reserve(kept.size());
    for (const int piece : kept) rest.emplace_back(piece, wayThrough(pieces, piece, frame));
    auto next = std::min_element(rest.begin(), rest.end(), [](const auto& a, const auto& b) {
        return height(a.second.lowest) < height(b.second.lowest);
    });
    glm::dvec3 end = next->second.fromLowest;
    std::vector<int> order;
    for (;;) {
        order.push_back(next->first);
        rest.erase(next);
        if (rest.empty()) return order;
        const auto gap = [&](const PieceWay& w) {
            return std::min(glm::distance(w.ends[0], end), glm::distance(w.ends[1], end));
        };
        next = std::min_element(rest.begin(), rest.end(),
                                [&](const auto& a, const auto& b) { return gap(a.second) < gap(b.second); });
        const PieceWay& way = next->second;
        end = glm::distance(way.ends[0], end) < glm::distance(way.ends[1], end) ? way.ends[1] : way.ends[0];
    }
}

LumenCrop cropAround(const Pieces& pieces, const std::vector<int>& kept, const VolumeFrame& study) {
    glm::ivec3 first(std::numeric_limits<int>::max()), last(std::numeric_limits<int>::min());
    for (const int piece : kept) {
        first = glm::min(first, pieces.parts.list[static_cast<std::size_t>(piece)].first);
        last = glm::max(last, pieces.parts.list[static_cast<std::size_t>(piece)].last);
    }
    return cropAround(first, last, kLumenMargin, study);
}

LumenCrop cropAround(glm::ivec3 first, glm::ivec3 last, int margin, const VolumeFrame& study) {
    LumenCrop crop;
    glm::ivec3 end(0);
    for (int a = 0; a < 3; ++a) {
        crop.first[a] = first[a] == 0 ? -margin : std::max(0, first[a] - margin);
        end[a] = last[a] == study.size[a] - 1 ? study.size[a] + margin
                                              : std::min(study.size[a], last[a] + 1 + margin);
    }
    crop.frame = study.cropped(crop.first, end - crop.first);
    return crop;
}

void checkLumenMemory(const LumenCrop& crop) {
    // The field, the lumen, marks or cells, distances; and squares of these, of some lines at a time
    // (distance_transform.cpp).
    constexpr double kBytes = 2 + 1 + 1 + 2, kSquares = 1 << 24, kFewestLines = 64;
    const glm::ivec3 size = crop.frame.size;
    const double voxels = static_cast<double>(crop.frame.count());
    const double squares = std::max(kSquares, kFewestLines * size.x * size.z);
    checkMemory(fmt::format("a lumen of {} x {} x {} voxels", size.x, size.y, size.z),
                kBytes * voxels + sizeof(float) * std::min(voxels, squares),
                "name its pieces with --seed x,y,z, or make the study coarser");
}

void setSegments(const Pieces& pieces, const std::vector<int>& ordered, LumenField& lumen) {
    const VolumeFrame& frame = lumen.field.frame;
    std::vector<std::uint8_t> numbers(pieces.parts.list.size(), 0);
    for (std::size_t n = 0; n < ordered.size(); ++n) {
        const Component& part = pieces.parts.list[static_cast<std::size_t>(ordered[n])];
        numbers[static_cast<std::size_t>(ordered[n])] = static_cast<std::uint8_t>(n + 1);
        const double voxel = frame.spacing.x * frame.spacing.y * frame.spacing.z;
        lumen.segments.push_back(
            {part.voxels, static_cast<double>(part.voxels) * voxel, part.first, part.last});
    }
    lumen.lumen = MaskVolume(frame);
    parallelFor(frame.size.z, [&](int k) {
        for (int j = 0; j < frame.size.y; ++j) {
            const std::size_t row = pieces.runs.rowNumber(j, k);
            for (std::uint32_t n = pieces.runs.rowStart[row]; n < pieces.runs.rowStart[row + 1]; ++n)
                if (const std::uint8_t number = numbers[pieces.parts.ofRun[n]])
                    std::fill_n(&lumen.lumen.at(pieces.runs.runs[n].first, j, k),
                                pieces.runs.runs[n].end - pieces.runs.runs[n].first, number);
        }
    });
}

}  // namespace stereonav
