// Levels of cells, each with its mean light and how much of it is known: pulled up by averaging what is
// known, pushed down where a cell knows less than a whole surface through it would give.
#include "engine/light/transfer/light_beyond.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kBlock = 4;        // texels along an edge of a cell of the first level
constexpr int kBeyondBrick = 8;  // side of a brick of the light, in texels

// Light in rgb, in a how much is known of it, 0..1.
struct Level {
    glm::ivec3 size{0};
    std::vector<glm::vec4> cells;

    explicit Level(const glm::ivec3& s) : size(s), cells(static_cast<std::size_t>(s.x) * s.y * s.z) {}
    glm::vec4& at(int i, int j, int k) {
        return cells[(static_cast<std::size_t>(k) * size.y + j) * size.x + i];
    }
    const glm::vec4& at(int i, int j, int k) const { return const_cast<Level*>(this)->at(i, j, k); }
};

// sum: light times weight, and the weights, of a cell's `parts`, up to edge^3; a surface right across it is
// one part of `edge` of them.
glm::vec4 cellOf(const glm::vec4& sum, int parts, int edge) {
    if (!(sum.w > 0)) return glm::vec4(0);
    return {glm::vec3(sum) / sum.w,
            std::min(sum.w * static_cast<float>(edge) / static_cast<float>(parts), 1.0f)};
}

glm::vec4 sumOfBlock(const PackedTexel* brick, const glm::ivec3& first) {
    glm::vec4 sum(0);
    for (int k = 0; k < kBlock; ++k)
        for (int j = 0; j < kBlock; ++j)
            for (int i = 0; i < kBlock; ++i) {
                const PackedTexel texel = brick[(first.z + k) * kBeyondBrick * kBeyondBrick +
                                                (first.y + j) * kBeyondBrick + first.x + i];
                if (texel == 0) continue;
                const float weight = texelWeight(texel);
                sum += glm::vec4(texelLight(texel) * weight, weight);
            }
    return sum;
}

int partsIn(const glm::ivec3& size, const glm::ivec3& cell, int edge) {
    const glm::ivec3 inside = glm::min(size - edge * cell, edge);
    return inside.x * inside.y * inside.z;
}

// size: of the light.
void addBrick(const PackedTexel* brick, const glm::ivec3& place, const glm::ivec3& size, Level& to) {
    constexpr int kTexels = kBeyondBrick * kBeyondBrick * kBeyondBrick;
    if (std::all_of(brick, brick + kTexels, [](PackedTexel t) { return t == 0; })) return;
    constexpr int kBlocks = kBeyondBrick / kBlock;
    for (int n = 0; n < kBlocks * kBlocks * kBlocks; ++n) {
        const glm::ivec3 block(n & 1, n >> 1 & 1, n >> 2), cell = kBlocks * place + block;
        if (cell.x < to.size.x && cell.y < to.size.y && cell.z < to.size.z)
            to.at(cell.x, cell.y, cell.z) =
                cellOf(sumOfBlock(brick, kBlock * block), partsIn(size, cell, kBlock), kBlock);
    }
}

Level firstLevel(const IlluminationVolume& light) {
    Level level((light.frame.size + kBlock - 1) / kBlock);
    const glm::ivec3 bricks = light.layout.bricks;
    parallelFor(bricks.z, [&](int z) {
        for (int y = 0; y < bricks.y; ++y)
            for (int x = 0; x < bricks.x; ++x)
                addBrick(light.texels.data() +
                             light.layout.index(kBeyondBrick * x, kBeyondBrick * y, kBeyondBrick * z),
                         {x, y, z}, light.frame.size, level);
    });
    return level;
}

Level pulled(const Level& fine) {
    Level coarse((fine.size + 1) / 2);
    parallelFor(coarse.size.z, [&](int k) {
        for (int j = 0; j < coarse.size.y; ++j)
            for (int i = 0; i < coarse.size.x; ++i) {
                glm::vec4 sum(0);
                for (int n = 0; n < 8; ++n) {
                    const glm::ivec3 c(2 * i + (n & 1), 2 * j + (n >> 1 & 1), 2 * k + (n >> 2));
                    if (c.x >= fine.size.x || c.y >= fine.size.y || c.z >= fine.size.z) continue;
                    const glm::vec4& cell = fine.at(c.x, c.y, c.z);
                    sum += glm::vec4(glm::vec3(cell) * cell.w, cell.w);
                }
                coarse.at(i, j, k) = cellOf(sum, partsIn(fine.size, {i, j, k}, 2), 2);
            }
    });
    return coarse;
}

// Returns the light of the coarser level, trilinear at the middle of a cell; beyond its faces the outermost
// cells are repeated.
glm::vec3 above(const Level& coarse, const glm::ivec3& cell) {
    const glm::ivec3 own = cell / 2;
    const glm::ivec3 side =
        glm::clamp(own + (cell & 1) * 2 - 1, glm::ivec3(0), coarse.size - 1);  // the nearer neighbours
    glm::vec3 sum(0);
    for (int n = 0; n < 8; ++n) {
        const bool x = n & 1, y = n >> 1 & 1, z = n >> 2;
        const float weight = (x ? 0.25f : 0.75f) * (y ? 0.25f : 0.75f) * (z ? 0.25f : 0.75f);
        sum += weight * glm::vec3(coarse.at(x ? side.x : own.x, y ? side.y : own.y, z ? side.z : own.z));
    }
    return sum;
}

// coarse is known everywhere, and fine afterwards.
void push(const Level& coarse, Level& fine) {
    parallelFor(fine.size.z, [&](int k) {
        for (int j = 0; j < fine.size.y; ++j)
            for (int i = 0; i < fine.size.x; ++i) {
                glm::vec4& cell = fine.at(i, j, k);
                if (cell.w < 1)
                    cell = glm::vec4(glm::mix(above(coarse, {i, j, k}), glm::vec3(cell), cell.w), 1.0f);
            }
    });
}

// No cells where nothing is known.
Level spread(const IlluminationVolume& light) {
    std::vector<Level> levels{firstLevel(light)};
    while (std::max({levels.back().size.x, levels.back().size.y, levels.back().size.z}) > 1)
        levels.push_back(pulled(levels.back()));
    glm::vec4& top = levels.back().cells[0];
    if (!(top.w > 0)) return Level(glm::ivec3(0));
    top.w = 1;
    for (std::size_t n = levels.size() - 1; n-- > 0;) push(levels[n + 1], levels[n]);
    return std::move(levels.front());
}

void write(const Level& level, IlluminationVolume& to) {
    for (int k = 0; k < level.size.z; ++k)
        for (int j = 0; j < level.size.y; ++j)
            for (int i = 0; i < level.size.x; ++i)
                to.texels[to.layout.index(i, j, k)] = packTexel(glm::vec3(level.at(i, j, k)), 1);
}

}  // namespace

IlluminationVolume lightBeyond(const IlluminationVolume& light) {
    if (light.empty()) return {};
    const Level level = spread(light);
    if (level.cells.empty()) return {};
    VolumeFrame frame = light.frame;
    frame.size = level.size;
    frame.spacing = light.frame.spacing * static_cast<double>(kBlock);
    frame.origin = light.frame.worldFromVoxel(glm::dvec3(0.5 * (kBlock - 1)));
    IlluminationVolume beyond(frame);
    write(level, beyond);
    return beyond;
}

void updateLightBeyond(const IlluminationVolume& light, IlluminationVolume& beyond) {
    if (light.empty() || beyond.empty()) return;
    write(spread(light), beyond);
}

}  // namespace stereonav
