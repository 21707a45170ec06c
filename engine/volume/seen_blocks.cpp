#include "engine/volume/seen_blocks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kStoredNumbers = 65536, kFirstStored = -32768;
constexpr double kCrumb = 0.0005;  // share of what is seen

// Returns the voxels of a block along each axis: blocks are cubes as far as voxels allow.
glm::ivec3 blockOf(const VolumeFrame& frame) {
    const glm::dvec3 extent = glm::dvec3(frame.size) * frame.spacing;
    const double edge = std::max({extent.x, extent.y, extent.z}) / SeenBlocks::kMostBlocks;
    glm::ivec3 block(1);
    for (int axis = 0; axis < 3; ++axis) {
        const int least = (frame.size[axis] + SeenBlocks::kMostBlocks - 1) / SeenBlocks::kMostBlocks;
        const double wanted = std::min(std::round(edge / frame.spacing[axis]), double(frame.size[axis]));
        block[axis] = std::max({1, least, static_cast<int>(wanted)});
    }
    return block;
}

void countRow(const std::int16_t* row, int length, const std::uint8_t* seen, int block,
              std::uint32_t* counts) {
    for (int i = 0; i < length; i += block, ++counts) {
        const int end = std::min(i + block, length);
        std::uint32_t count = 0;
        for (int n = i; n < end; ++n) count += seen[row[n] - kFirstStored];
        *counts += count;
    }
}

template <typename Use>
void forNeighbours(const glm::ivec3& at, const Use& use) {
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if (x != 0 || y != 0 || z != 0) use(at + glm::ivec3(x, y, z), glm::ivec3(x, y, z));
}

bool isBorder(const SeenBlocks& blocks, const glm::ivec3& at) {
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
            glm::ivec3 beside = at;
            beside[axis] += side;
            if (blocks.at(beside) == 0) return true;
        }
    return false;
}

// The outward normal of a block in the world; 0 where its surroundings are alike.
glm::vec3 normalOf(const SeenBlocks& blocks, const glm::ivec3& at) {
    glm::dvec3 sum(0.0);
    forNeighbours(at, [&](const glm::ivec3& beside, const glm::ivec3& step) {
        sum -= static_cast<double>(blocks.at(beside)) * glm::dvec3(step) / glm::length(glm::dvec3(step));
    });
    const glm::dvec3 edges = blocks.frame.spacing * glm::dvec3(blocks.block);
    sum = blocks.frame.axes * (sum / (edges / std::max({edges.x, edges.y, edges.z})));
    const double length = glm::length(sum);
    return length > 0 ? glm::vec3(sum / length) : glm::vec3(0.0f);
}

template <typename Use>
void forBlocks(const SeenBlocks& blocks, const Use& use) {
    for (int k = 0; k < blocks.size.z; ++k)
        for (int j = 0; j < blocks.size.y; ++j)
            for (int i = 0; i < blocks.size.x; ++i) use(glm::ivec3(i, j, k));
}

}  // namespace

SeenNumbers seenFrom(double stored) {
    SeenNumbers seen(kStoredNumbers);
    for (int n = 0; n < kStoredNumbers; ++n) seen[n] = n + kFirstStored >= stored;
    return seen;
}

glm::dvec3 SeenBlocks::middle(const glm::ivec3& place) const {
    const glm::dvec3 first = glm::dvec3(place * block);
    const glm::dvec3 last = glm::min(first + glm::dvec3(block), glm::dvec3(frame.size)) - 1.0;
    return frame.worldFromVoxel(0.5 * (first + last));
}

SeenBlocks seenBlocks(const GreyVolume& grey, const SeenNumbers& seen) {
    SeenBlocks blocks;
    blocks.frame = grey.frame;
    if (grey.empty()) return blocks;
    blocks.block = blockOf(grey.frame);
    const glm::ivec3 size = grey.frame.size;
    blocks.size = (size + blocks.block - 1) / blocks.block;
    blocks.voxels.assign(static_cast<std::size_t>(blocks.size.x) * blocks.size.y * blocks.size.z, 0);
    parallelFor(blocks.size.z, [&](int layer) {
        const int first = layer * blocks.block.z, end = std::min(first + blocks.block.z, size.z);
        for (int k = first; k < end; ++k)
            for (int j = 0; j < size.y; ++j)
                countRow(&grey.values[grey.frame.index(0, j, k)], size.x, seen.data(), blocks.block.x,
                         &blocks.voxels[blocks.index({0, j / blocks.block.y, layer})]);
    });
    return blocks;
}

void dropCrumbs(SeenBlocks& blocks) {
    double all = 0, kept = 0;
    for (const std::uint32_t count : blocks.voxels) all += count;
    std::vector<std::uint8_t> known(blocks.voxels.size());
    std::vector<glm::ivec3> piece, crumbs;
    forBlocks(blocks, [&](const glm::ivec3& start) {
        if (blocks.at(start) == 0 || known[blocks.index(start)]) return;
        piece.assign(1, start);
        known[blocks.index(start)] = 1;
        double voxels = 0;
        for (std::size_t n = 0; n < piece.size(); ++n) {
            const glm::ivec3 here = piece[n];
            voxels += blocks.at(here);
            forNeighbours(here, [&](const glm::ivec3& beside, const glm::ivec3&) {
                if (blocks.at(beside) == 0 || known[blocks.index(beside)]) return;
                known[blocks.index(beside)] = 1;
                piece.push_back(beside);
            });
        }
        if (voxels >= kCrumb * all)
            kept += voxels;
        else
            crumbs.insert(crumbs.end(), piece.begin(), piece.end());
    });
    if (kept < 0.5 * all) return;  // the object is made of crumbs
    for (const glm::ivec3& crumb : crumbs) blocks.voxels[blocks.index(crumb)] = 0;
}

std::vector<SurfaceSample> surfaceOf(const SeenBlocks& blocks) {
    std::vector<SurfaceSample> samples;
    forBlocks(blocks, [&](const glm::ivec3& at) {
        if (blocks.at(at) > 0 && isBorder(blocks, at))
            samples.push_back({blocks.middle(at), normalOf(blocks, at)});
    });
    return samples;
}

}  // namespace stereonav
