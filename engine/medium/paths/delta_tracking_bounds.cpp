// Extinction ranges of a grid of voxels from the values of blocks, and of height layers from the heights in
// columns; both widened by what the perturbation may move and change.
#include "engine/medium/paths/delta_tracking_bounds.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "engine/base/parallel.h"
#include "engine/medium/paths/delta_tracking_noise.h"

namespace stereonav {
namespace {

constexpr int kCellsAlongLongest = 64;      // cells cost a few ns a step, a reading 50 ns and more
constexpr float kRounding = 1e-5f;          // readings and tables round differently: far above float's
constexpr int kColumns = 48, kLevels = 24;  // cells over layers: along x and y, and upwards

struct ValueRange {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    bool empty() const { return low > high; }
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void add(const ValueRange& other) {
        low = std::min(low, other.low);
        high = std::max(high, other.high);
    }
};

// Least extinction between two values over every gradient: entries are linear between.
float leastExtinction(const MediumTable& table, const ValueRange& values) {
    const auto entry = [&](double value) {
        return std::clamp((value - table.firstValue) * table.perValue, 0.0,
                          static_cast<double>(MediumTable::kValues));
    };
    const int first = static_cast<int>(std::floor(entry(values.low)));
    const int last = static_cast<int>(std::ceil(entry(values.high)));
    float least = std::numeric_limits<float>::infinity();
    for (int row = 0; row < table.rows; ++row)
        for (int n = first; n <= last; ++n)
            least = std::min(
                least,
                table.entries[static_cast<std::size_t>(row) * (MediumTable::kValues + 1) + n].extinction);
    return least;
}

ExtinctionRange widened(const ExtinctionRange& range, const NoiseBounds& noise) {
    return {range.least * static_cast<float>(noise.leastFactor) * (1 - kRounding),
            range.most * static_cast<float>(noise.mostFactor) * (1 + kRounding)};
}

// Ranges of the values of blocks of voxels, faces shared with the next block included.
class BlockValues {
public:
    BlockValues(const GreyVolume& field, int block) : mField(field), mBlock(block) {
        mSize = (field.frame.size - 2 + block) / block;  // blocks of the size - 1 intervals between voxels
        mSize = glm::max(mSize, glm::ivec3(1));
        mRanges.resize(static_cast<std::size_t>(mSize.x) * mSize.y * mSize.z);
        parallelFor(mSize.z, [this](int k) {
            for (int j = 0; j < mSize.y; ++j)
                for (int i = 0; i < mSize.x; ++i) mRanges[index({i, j, k})] = rangeOf({i, j, k});
        });
    }
    const glm::ivec3& size() const { return mSize; }
    // The range of everything that a place between two voxel coordinates reads.
    ValueRange between(const glm::dvec3& low, const glm::dvec3& high) const {
        const glm::dvec3 each(static_cast<double>(mBlock));
        const glm::ivec3 first = inside(glm::floor(low / each)), last = inside(glm::ceil(high / each) - 1.0);
        ValueRange range;
        for (int k = first.z; k <= last.z; ++k)
            for (int j = first.y; j <= last.y; ++j)
                for (int i = first.x; i <= last.x; ++i) range.add(mRanges[index({i, j, k})]);
        return range;
    }

private:
    std::size_t index(const glm::ivec3& b) const {
        return (static_cast<std::size_t>(b.z) * mSize.y + b.y) * mSize.x + b.x;
    }
    glm::ivec3 inside(const glm::dvec3& block) const {
        return glm::clamp(glm::ivec3(block), glm::ivec3(0), mSize - 1);
    }
    ValueRange rangeOf(const glm::ivec3& block) const {
        const glm::ivec3 first = block * mBlock;
        const glm::ivec3 last = glm::min(first + mBlock, mField.frame.size - 1);
        ValueRange range;
        for (int k = first.z; k <= last.z; ++k)
            for (int j = first.y; j <= last.y; ++j)
                for (int i = first.x; i <= last.x; ++i)
                    range.add(mField.at(i, j, k) * mField.scale + mField.offset);
        return range;
    }

    const GreyVolume& mField;
    int mBlock;
    glm::ivec3 mSize{1};
    std::vector<ValueRange> mRanges;
};

// Voxel coordinates that a box of the world spans along each of the grid's axes.
struct VoxelBox {
    glm::dvec3 low, high;
};
VoxelBox spanned(const VolumeFrame& frame, const glm::dvec3& low, const glm::dvec3& high) {
    VoxelBox box{glm::dvec3(0.0), glm::dvec3(0.0)};
    for (int a = 0; a < 3; ++a)
        for (int world = 0; world < 3; ++world) {
            const double each = frame.axes[a][world] / frame.spacing[a];
            box.low[a] += std::min(each * low[world], each * high[world]);
            box.high[a] += std::max(each * low[world], each * high[world]);
        }
    return box;
}

// The world's box around a box of voxel coordinates.
WorldBox worldBoxOf(const VolumeFrame& frame, const VoxelBox& voxels) {
    const glm::dvec3 middle = frame.worldFromVoxel(0.5 * (voxels.low + voxels.high));
    glm::dvec3 half{0.0};
    for (int a = 0; a < 3; ++a)
        half += glm::abs(frame.axes[a]) * (0.5 * frame.spacing[a] * (voxels.high[a] - voxels.low[a]));
    return {middle - half, middle + half};
}

// Extinction over the places of a box of voxel coordinates, before they are displaced.
ExtinctionRange rangeWithin(const Medium& medium, const BlockValues& blocks, const VoxelBox& cell,
                            double time) {
    const VolumeFrame& frame = medium.field()->frame;
    const NoiseBounds noise =
        boundNoise(medium.perturbation(), medium.noise(), worldBoxOf(frame, cell), time);
    const VoxelBox moved = spanned(frame, noise.low, noise.high);
    const glm::dvec3 low = cell.low + moved.low, high = cell.high + moved.high;
    const glm::dvec3 farthest = glm::dvec3(frame.size - 1);
    if (glm::any(glm::greaterThan(low, farthest)) || glm::any(glm::lessThan(high, glm::dvec3(0.0))))
        return {};
    const ValueRange values = blocks.between(low, high);
    ExtinctionRange range{leastExtinction(medium.table(), values),
                          medium.table().largestExtinction(values.low, values.high)};
    if (glm::any(glm::lessThan(low, glm::dvec3(0.0))) || glm::any(glm::greaterThan(high, farthest)))
        range.least = 0;
    return widened(range, noise);
}

ExtinctionBounds boundsOfField(const Medium& medium, double time) {
    const GreyVolume& field = *medium.field();
    const VolumeFrame& frame = field.frame;
    const int longest = std::max({frame.size.x, frame.size.y, frame.size.z}) - 1;
    const int block = std::max(1, (longest + kCellsAlongLongest - 1) / kCellsAlongLongest);
    const double displacement = medium.perturbation().largestDisplacement();
    const glm::dvec3 reach = spanned(frame, glm::dvec3(-displacement), glm::dvec3(displacement)).high;
    const glm::dvec3 edge(static_cast<double>(block)), farthest = glm::dvec3(frame.size - 1) + reach;
    ExtinctionBounds bounds;
    bounds.extent = (farthest + reach) / edge;
    bounds.size = glm::max(glm::ivec3(glm::ceil(bounds.extent)), glm::ivec3(1));
    bounds.origin = frame.worldFromVoxel(-reach);
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 unit{0.0};
        unit[column] = 1;
        bounds.cellsFromWay[column] = frame.voxelDirection(unit) / edge;
    }
    bounds.cells.resize(static_cast<std::size_t>(bounds.size.x) * bounds.size.y * bounds.size.z);
    const BlockValues blocks(field, block);
    parallelFor(bounds.size.z, [&](int k) {
        for (int j = 0; j < bounds.size.y; ++j)
            for (int i = 0; i < bounds.size.x; ++i) {
                const glm::dvec3 low = edge * glm::dvec3(i, j, k) - reach;
                bounds.cells[bounds.index({i, j, k})] =
                    rangeWithin(medium, blocks, {low, glm::min(low + edge, farthest)}, time);
            }
    });
    return bounds;
}

// Heights of a layer that places between two corners may read; NaN ones are skipped.
ValueRange heightsBetween(const HeightLayer& layer, const glm::dvec3& low, const glm::dvec3& high) {
    const Plane<float>& heights = layer.levels.front();
    const auto sample = [&](double at, double origin, int count) {
        return std::clamp((at - origin) / layer.spacing, 0.0, static_cast<double>(count - 1));
    };
    const int x0 = static_cast<int>(std::floor(sample(low.x, layer.originX, heights.width())));
    const int x1 = static_cast<int>(std::ceil(sample(high.x, layer.originX, heights.width())));
    const int y0 = static_cast<int>(std::floor(sample(low.y, layer.originY, heights.height())));
    const int y1 = static_cast<int>(std::ceil(sample(high.y, layer.originY, heights.height())));
    ValueRange range;
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x)
            if (!std::isnan(heights.at(x, y))) range.add(heights.at(x, y));
    return range;
}

// Extinctions of all layers whose heights let them reach the box, added.
ExtinctionRange rangeWithin(const Medium& medium, const WorldBox& box, double time) {
    const NoiseBounds noise = boundNoise(medium.perturbation(), medium.noise(), box, time);
    const glm::dvec3 low = box.low + noise.low, high = box.high + noise.high;
    ExtinctionRange sum;
    for (const HeightLayer& layer : medium.layers()) {
        if (layer.levels.empty() || layer.levels.front().empty()) continue;
        const ValueRange heights = heightsBetween(layer, low, high);
        if (heights.empty() || high.z < heights.low - layer.below || low.z > heights.high + layer.above)
            continue;
        sum.most += layer.table.largestExtinction(heights.low, heights.high);
    }
    return widened(sum, noise);
}

ExtinctionBounds boundsOfLayers(const Medium& medium, double time) {
    ExtinctionBounds bounds;
    bounds.size = glm::ivec3(kColumns, kColumns, kLevels);
    bounds.extent = glm::dvec3(bounds.size);
    bounds.origin = medium.bounds().low;
    const glm::dvec3 cell = (medium.bounds().high - medium.bounds().low) / bounds.extent;
    bounds.cellsFromWay = glm::dmat3(0.0);
    for (int a = 0; a < 3; ++a) bounds.cellsFromWay[a][a] = 1 / cell[a];
    bounds.cells.resize(static_cast<std::size_t>(bounds.size.x) * bounds.size.y * bounds.size.z);
    parallelFor(bounds.size.z, [&](int k) {
        for (int j = 0; j < bounds.size.y; ++j)
            for (int i = 0; i < bounds.size.x; ++i) {
                const glm::dvec3 low = bounds.origin + cell * glm::dvec3(i, j, k);
                bounds.cells[bounds.index({i, j, k})] = rangeWithin(medium, {low, low + cell}, time);
            }
    });
    return bounds;
}

}  // namespace

ExtinctionBounds makeExtinctionBounds(const Medium& medium, double time) {
    if (medium.bounds().empty()) return {};
    return medium.field() ? boundsOfField(medium, time) : boundsOfLayers(medium, time);
}

}  // namespace stereonav
