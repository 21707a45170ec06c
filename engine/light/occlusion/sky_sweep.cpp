#include "engine/light/occlusion/sky_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/occlusion/occlusion_rays.h"

namespace stereonav {
namespace {

constexpr int kMargin = 2;       // open cells around the volume
constexpr int kRows = 8;         // rows of a slab that a thread takes at once
constexpr int kSamples = 4;      // voxels an axis that are looked at in a cell, at most twice as many
constexpr int kKeyRays = 6;      // directions to the key light's edge
constexpr double kGrowth = 1.1;  // factor on a cell's edge from one try to the next

glm::dvec3 cellsFor(const VolumeFrame& frame, double edge) {
    return glm::max(glm::round(edge / frame.spacing), glm::dvec3(1.0));
}
glm::ivec3 sizeFor(const VolumeFrame& frame, const glm::dvec3& voxels) {
    return glm::ivec3(glm::ceil(glm::dvec3(frame.size) / voxels)) + 2 * kMargin;
}
double countOf(const glm::ivec3& size) {
    return static_cast<double>(size.x) * size.y * size.z;
}

SkyGrid gridFor(const VolumeFrame& frame, std::size_t mostCells) {
    double edge = std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    SkyGrid grid;
    for (;; edge *= kGrowth) {
        grid.cellVoxels = cellsFor(frame, edge);
        grid.size = sizeFor(frame, grid.cellVoxels);
        const bool least = grid.size == glm::ivec3(1 + 2 * kMargin);
        if (least || countOf(grid.size) <= static_cast<double>(mostCells)) break;
    }
    grid.first = 0.5 * (grid.cellVoxels - 1.0) - static_cast<double>(kMargin) * grid.cellVoxels;
    return grid;
}

// What a voxel takes of light, by its stored number: of an opaque surface all or nothing, else its extinction
// a metre.
std::vector<float> takenByNumber(const VolumeScene& scene) {
    std::vector<float> taken(65536);
    const TransferFunction& transfer = scene.look.transfer;
    for (int n = 0; n < 65536; ++n) {
        const int stored = n - 32768;
        const double value = stored * scene.field.scale + scene.field.offset;
        taken[n] = transfer.empty() ? (static_cast<float>(stored) >= scene.cells.isovalue ? 1.0f : 0.0f)
                                    : static_cast<float>(transfer.extinction(value));
    }
    return taken;
}

// The share of light that passes each cell, x fastest.
class PassingCells {
public:
    PassingCells(const VolumeScene& scene, const SkyGrid& grid)
        : mScene(scene), mGrid(grid), mTaken(takenByNumber(scene)), mCells(grid.cellVoxels) {
        const glm::dvec3 edges = grid.cellVoxels * scene.field.frame.spacing;
        mEdge = std::cbrt(edges.x * edges.y * edges.z);
        mStep = glm::max(mCells / kSamples, 1);
        mSloping = scene.look.transfer.empty() && mCells == glm::ivec3(1);
    }

    LazyArray<float> make() const {
        LazyArray<float> passing(mGrid.count());
        parallelFor(mGrid.size.z, [&](int k) {
            float* to = passing.data() + static_cast<std::size_t>(k) * mGrid.size.y * mGrid.size.x;
            for (int j = 0; j < mGrid.size.y; ++j)
                for (int i = 0; i < mGrid.size.x; ++i) *to++ = passes(glm::ivec3(i, j, k));
        });
        return passing;
    }

private:
    // Which part of a voxel the surface has below it, by how the values change there. All or nothing would
    // make stairs that low light casts shadows from.
    float covered(const glm::ivec3& voxel) const {
        const GreyVolume& field = mScene.field;
        const glm::ivec3 last = field.frame.size - 1;
        int change = 1;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 low = voxel, high = voxel;
            low[axis] = std::max(voxel[axis] - 1, 0);
            high[axis] = std::min(voxel[axis] + 1, last[axis]);
            change = std::max(change, std::abs(field.at(high) - field.at(low)));
        }
        const float over = static_cast<float>(field.at(voxel)) - mScene.cells.isovalue;
        return std::clamp(0.5f + 2 * over / static_cast<float>(change), 0.0f, 1.0f);
    }

    float passes(const glm::ivec3& cell) const {
        const GreyVolume& field = mScene.field;
        const Volume<std::uint8_t>* modulation =
            mScene.look.transfer.empty() ? nullptr : mScene.look.modulation.get();
        const glm::ivec3 first = glm::max((cell - kMargin) * mCells, 0);
        const glm::ivec3 end = glm::min((cell - kMargin + 1) * mCells, field.frame.size);
        if (first.x >= end.x || first.y >= end.y || first.z >= end.z) return 1;
        if (mSloping) return 1 - covered(first);
        float sum = 0;
        int count = 0;
        for (int k = first.z; k < end.z; k += mStep.z)
            for (int j = first.y; j < end.y; j += mStep.y)
                for (int i = first.x; i < end.x; i += mStep.x, ++count) {
                    const std::size_t n = field.frame.index(i, j, k);
                    const float taken = mTaken[field.values[n] + 32768];
                    sum += modulation ? taken * static_cast<float>(modulation->values[n]) / 255 : taken;
                }
        const double mean = static_cast<double>(sum) / count;
        // A wall thinner than a cell hides most of what is behind it.
        return static_cast<float>(mScene.look.transfer.empty() ? (1 - mean) * (1 - mean)
                                                               : std::exp(-mean * mEdge));
    }

    const VolumeScene& mScene;
    const SkyGrid& mGrid;
    std::vector<float> mTaken;
    glm::ivec3 mCells, mStep{1};
    double mEdge = 0;       // metres
    bool mSloping = false;  // an opaque surface, in cells of one voxel
};

// Sums over directions, for each cell.
struct SkySums {
    std::array<LazyArray<float>, 4> sky;  // share that is seen, and its directions along x, y, z
    LazyArray<float> key;

    explicit SkySums(std::size_t count) : key(count) {
        for (LazyArray<float>& sum : sky) sum = LazyArray<float>(count);
    }
};

// One direction to where light comes from, as a sweep along an axis sees it.
struct SweptRay {
    std::array<float, 3> world{};
    bool key = false;
    int u = 0, v = 0;    // whole cells to the side, from a slab to the one before: -1 or 0
    float weights[4]{};  // shares of the four cells there
    float keeps = 1;     // share of what is missing that is still missing a slab on
};

// Cells in slabs along an axis: where in an array they lie, u one after the other.
struct SlabLayout {
    int slabs = 0, rows = 0, columns = 0;
    std::size_t slab = 0, row = 0;  // cells from one to the next
};

// Light that leaves the cells of a slab, with a border of open ones.
class SlabLight {
public:
    explicit SlabLight(const SlabLayout& layout)
        : mStride(static_cast<std::size_t>(layout.columns) + 2),
          mLight(mStride * (static_cast<std::size_t>(layout.rows) + 2), 1.0f) {}
    float* row(int v, int u = 0) {
        return mLight.data() + mStride * static_cast<std::size_t>(v + 1) + static_cast<std::size_t>(u + 1);
    }
    std::size_t stride() const { return mStride; }

private:
    std::size_t mStride;
    std::vector<float> mLight;
};

// What arrives at a row of cells, and leaves it.
void sweepRow(const SweptRay& ray, const float* before, std::size_t stride, const float* passing, int count,
              float* arriving, float* leaving) {
    const float* const next = before + stride;
    const float a = ray.weights[0], b = ray.weights[1], c = ray.weights[2], d = ray.weights[3];
    const float keeps = ray.keeps, back = 1 - ray.keeps;
    for (int n = 0; n < count; ++n) {
        const float light = (a * before[n] + b * before[n + 1]) + (c * next[n] + d * next[n + 1]);
        arriving[n] = light;
        leaving[n] = back + keeps * (light * passing[n]);
    }
}

void addRow(const SweptRay& ray, const float* light, int count, std::size_t at, SkySums& sums) {
    if (ray.key) {
        float* const to = sums.key.data() + at;
        for (int n = 0; n < count; ++n) to[n] += light[n];
        return;
    }
    float* const all = sums.sky[0].data() + at;
    for (int n = 0; n < count; ++n) all[n] += light[n];
    for (int axis = 0; axis < 3; ++axis) {
        float* const to = sums.sky[static_cast<std::size_t>(axis) + 1].data() + at;
        const float along = ray.world[static_cast<std::size_t>(axis)];
        for (int n = 0; n < count; ++n) to[n] += along * light[n];
    }
}

// Sweeps all rays together that come along one axis from one side.
void sweepGroup(const std::vector<SweptRay>& rays, bool fromEnd, const SlabLayout& layout,
                const LazyArray<float>& passing, SkySums& sums, Progress& progress) {
    if (rays.empty()) return;
    std::vector<SlabLight> before(rays.size(), SlabLight(layout)), after = before;
    for (int n = 0; n < layout.slabs; ++n) {
        if (progress.cancelled()) throw Cancelled();
        const int slab = fromEnd ? layout.slabs - 1 - n : n;
        parallelFor((layout.rows + kRows - 1) / kRows, [&](int piece) {
            std::vector<float> arriving(static_cast<std::size_t>(layout.columns));
            const int end = std::min((piece + 1) * kRows, layout.rows);
            for (int v = piece * kRows; v < end; ++v)
                for (std::size_t r = 0; r < rays.size(); ++r) {
                    const SweptRay& ray = rays[r];
                    const std::size_t at = layout.slab * static_cast<std::size_t>(slab) +
                                           layout.row * static_cast<std::size_t>(v);
                    sweepRow(ray, before[r].row(v + ray.v, ray.u), before[r].stride(), passing.data() + at,
                             layout.columns, arriving.data(), after[r].row(v));
                    addRow(ray, arriving.data(), layout.columns, at, sums);
                }
        });
        std::swap(before, after);
    }
}

// Rays by the axis that they lie nearest to in cells, and the side that they come from.
struct RayGroups {
    std::array<std::array<std::vector<SweptRay>, 2>, 3> rays;  // by axis; 1: from the end

    RayGroups(const SkyGrid& grid, const VolumeFrame& frame, double reach)
        : mGrid(grid), mFrame(frame), mReach(reach) {}

    void add(const glm::dvec3& direction, bool key) {
        const glm::dvec3 cells = mFrame.voxelDirection(direction) / mGrid.cellVoxels;
        const glm::dvec3 size = glm::abs(cells);
        const int axis = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
        const int across = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
        SweptRay ray;
        for (int k = 0; k < 3; ++k) ray.world[static_cast<std::size_t>(k)] = static_cast<float>(direction[k]);
        ray.key = key;
        const auto [u, uRest] = split(cells[across] / size[axis]);
        const auto [v, vRest] = split(cells[down] / size[axis]);
        ray.u = u, ray.v = v;
        const double weights[4] = {(1 - uRest) * (1 - vRest), uRest * (1 - vRest), (1 - uRest) * vRest,
                                   uRest * vRest};
        for (int k = 0; k < 4; ++k) ray.weights[k] = static_cast<float>(weights[k]);
        const double step = 1 / size[axis];  // metres
        if (mReach > 0 && !key) ray.keeps = static_cast<float>(std::exp(-step / mReach));
        rays[static_cast<std::size_t>(axis)][cells[axis] > 0 ? 1 : 0].push_back(ray);
    }

private:
    // x: -1 to 1.
    static std::pair<int, double> split(double x) {
        const int whole = x < 0 ? -1 : 0;
        return {whole, std::clamp(x - whole, 0.0, 1.0)};
    }
    const SkyGrid& mGrid;
    const VolumeFrame& mFrame;
    double mReach;
};

void addRays(const SkySweepSetting& setting, RayGroups& groups) {
    for (const glm::dvec3& direction : occlusionDirections()) groups.add(direction, false);
    groups.add(setting.keyFrom, true);
    const glm::dvec3 other = std::abs(setting.keyFrom.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(other, setting.keyFrom)),
                     v = glm::cross(setting.keyFrom, u);
    for (int n = 0; n < kKeyRays; ++n) {
        const double angle = 2 * std::numbers::pi * n / kKeyRays;
        const glm::dvec3 aside = std::cos(angle) * u + std::sin(angle) * v;
        groups.add(glm::normalize(setting.keyFrom + setting.keyWidth * aside), true);
    }
}

// Returns the same cells with y fastest, then z, then x.
LazyArray<float> turned(const LazyArray<float>& cells, const glm::ivec3& size) {
    LazyArray<float> to(cells.size());
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                to[(static_cast<std::size_t>(i) * size.z + k) * size.y + j] =
                    cells[(static_cast<std::size_t>(k) * size.y + j) * size.x + i];
    });
    return to;
}

// Packs both sums; aside: those of cells as turned() has them.
void pack(const SkySums& sums, const SkySums& aside, SkyGrid& grid) {
    const glm::ivec3 size = grid.size;
    constexpr double kRays = 42, kKeys = kKeyRays + 1;
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const std::size_t n = (static_cast<std::size_t>(k) * size.y + j) * size.x + i;
                const std::size_t m = (static_cast<std::size_t>(i) * size.z + k) * size.y + j;
                const auto mean = [&](int channel) {
                    const auto c = static_cast<std::size_t>(channel);
                    return static_cast<double>(sums.sky[c][n] + aside.sky[c][m]) / kRays;
                };
                packSky({mean(1), mean(2), mean(3)}, mean(0),
                        static_cast<double>(sums.key[n] + aside.key[m]) / kKeys, grid.words.data() + 2 * n);
            }
    });
}

}  // namespace

SkyGrid sweepSky(const VolumeScene& scene, const SkySweepSetting& setting, Progress& progress) {
    constexpr const char* kSweeping = "light from the sky";
    const VolumeFrame& frame = scene.field.frame;
    if (std::min({frame.size.x, frame.size.y, frame.size.z}) < 2)
        throw Error("", "light from the sky",
                    fmt::format("expected at least 2 voxels along each axis, got {}x{}x{}", frame.size.x,
                                frame.size.y, frame.size.z),
                    "load a volume first");
    progress.report(0, kSweeping);
    SkyGrid grid = gridFor(frame, setting.mostCells);
    const LazyArray<float> passing = PassingCells(scene, grid).make();
    RayGroups groups(grid, frame, setting.reach);
    addRays(setting, groups);
    SkySums sums(grid.count()), aside(grid.count());
    const auto sweep = [&](std::size_t axis, const SlabLayout& layout, const LazyArray<float>& cells,
                           SkySums& to) {
        for (std::size_t side = 0; side < 2; ++side)
            sweepGroup(groups.rays[axis][side], side == 1, layout, cells, to, progress);
        progress.report(0.2 + 0.25 * static_cast<double>(axis), kSweeping);
    };
    const glm::ivec3 size = grid.size;
    const std::size_t x = static_cast<std::size_t>(size.x), y = static_cast<std::size_t>(size.y),
                      z = static_cast<std::size_t>(size.z);
    sweep(0, {size.x, size.z, size.y, z * y, y}, turned(passing, size), aside);
    sweep(1, {size.y, size.z, size.x, x, x * y}, passing, sums);
    sweep(2, {size.z, size.y, size.x, x * y, x}, passing, sums);
    grid.words = LazyArray<std::uint32_t>(2 * grid.count());
    pack(sums, aside, grid);
    progress.report(1, kSweeping);
    return grid;
}

double skySweepWorking(const VolumeFrame& frame, std::size_t mostCells) {
    constexpr double kCell = 4.0 * (2 + 2 * 5 + 2);  // passing twice, sums twice, what is returned
    return kCell * countOf(gridFor(frame, mostCells).size);
}

}  // namespace stereonav
