// Extinction ranges of a grid of voxels from the values of blocks, and of height layers from the heights in
// columns; both widened by what the perturbation may move and change.
#include "engine/medium/delta_tracking_bounds.h"

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kCellsAlongLongest = 40;      // cells cost a few ns a step, a reading 50 ns and more
constexpr float kRounding = 1e-5f;          // readings and tables round differently: far above float's
constexpr int kColumns = 48, kLevels = 24;  // of cells over layers

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

// Noise multiplies extinction, each scale by 1 plus at most its share; Bernoulli's inequality covers both
// products and sums of scales.
struct NoiseFactor {
    float least = 1, most = 1;
};
NoiseFactor noiseFactor(const Perturbation& perturbation) {
    NoiseFactor factor;
    for (const NoiseScale& scale : perturbation.scales) {
        factor.least -= std::abs(scale.extinction);
        factor.most *= 1 + std::abs(scale.extinction);
    }
    factor.least = std::max(factor.least, 0.0f);
    return factor;
}

ExtinctionRange widened(const ExtinctionRange& range, const NoiseFactor& factor) {
    return {range.least * factor.least * (1 - kRounding), range.most * factor.most * (1 + kRounding)};
}

// Ranges of the values of blocks of voxels, faces shared with the next block included.
class BlockValues {
public:
    BlockValues(const GreyVolume& field, int block) : mField(field), mBlock(block) {
        mSize = (field.frame.size - 2 + block) / block;  // of size - 1 intervals between voxels
        mSize = glm::max(mSize, glm::ivec3(1));
        mRanges.resize(static_cast<std::size_t>(mSize.x) * mSize.y * mSize.z);
        parallelFor(mSize.z, [this](int k) {
            for (int j = 0; j < mSize.y; ++j)
                for (int i = 0; i < mSize.x; ++i) mRanges[index({i, j, k})] = rangeOf({i, j, k});
        });
    }
    const glm::ivec3& size() const { return mSize; }
    // Of everything that a place between two voxel coordinates reads.
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

// How far a displacement may move a place, in voxels along each of the grid's axes.
glm::dvec3 reachInVoxels(const VolumeFrame& frame, double displacement) {
    glm::dvec3 reach{0.0};
    for (int a = 0; a < 3; ++a)
        for (int world = 0; world < 3; ++world)
            reach[a] += std::abs(frame.axes[a][world]) * displacement / frame.spacing[a];
    return reach;
}

void fillFromField(const Medium& medium, const BlockValues& blocks, int block, const glm::dvec3& reach,
                   ExtinctionBounds& bounds) {
    const glm::dvec3 farthest = glm::dvec3(medium.field()->frame.size - 1);
    const glm::dvec3 edge(static_cast<double>(block));
    const NoiseFactor factor = noiseFactor(medium.perturbation());
    parallelFor(bounds.size.z, [&](int k) {
        for (int j = 0; j < bounds.size.y; ++j)
            for (int i = 0; i < bounds.size.x; ++i) {
                const glm::dvec3 first = edge * glm::dvec3(i, j, k) - reach;
                const glm::dvec3 low = first - reach, high = glm::min(first + edge, farthest + reach) + reach;
                const ValueRange values = blocks.between(low, high);
                ExtinctionRange range{leastExtinction(medium.table(), values),
                                      medium.table().largestExtinction(values.low, values.high)};
                if (!(low.x >= 0 && low.y >= 0 && low.z >= 0 && high.x <= farthest.x &&
                      high.y <= farthest.y && high.z <= farthest.z))
                    range.least = 0;
                bounds.cells[(static_cast<std::size_t>(k) * bounds.size.y + j) * bounds.size.x + i] =
                    widened(range, factor);
            }
    });
}

ExtinctionBounds boundsOfField(const Medium& medium) {
    const GreyVolume& field = *medium.field();
    const VolumeFrame& frame = field.frame;
    const int longest = std::max({frame.size.x, frame.size.y, frame.size.z}) - 1;
    const int block = std::max(1, (longest + kCellsAlongLongest - 1) / kCellsAlongLongest);
    const glm::dvec3 reach = reachInVoxels(frame, medium.perturbation().largestDisplacement());
    ExtinctionBounds bounds;
    bounds.extent = (glm::dvec3(frame.size - 1) + 2.0 * reach) / static_cast<double>(block);
    bounds.size = glm::max(glm::ivec3(glm::ceil(bounds.extent)), glm::ivec3(1));
    bounds.origin = frame.worldFromVoxel(-reach);
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 unit{0.0};
        unit[column] = 1;
        bounds.cellsFromWay[column] = frame.voxelDirection(unit) / static_cast<double>(block);
    }
    bounds.cells.resize(static_cast<std::size_t>(bounds.size.x) * bounds.size.y * bounds.size.z);
    fillFromField(medium, BlockValues(field, block), block, reach, bounds);
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

// One column of cells, the extinction of each layer added where its heights let it reach.
void fillColumn(const Medium& medium, int i, int j, ExtinctionBounds& bounds) {
    const glm::dvec3 cell{1 / bounds.cellsFromWay[0][0], 1 / bounds.cellsFromWay[1][1],
                          1 / bounds.cellsFromWay[2][2]};
    const double reach = medium.perturbation().largestDisplacement();
    const NoiseFactor factor = noiseFactor(medium.perturbation());
    const glm::dvec3 foot = bounds.origin + cell * glm::dvec3(i, j, 0);
    for (const HeightLayer& layer : medium.layers()) {
        if (layer.levels.empty() || layer.levels.front().empty()) continue;
        const ValueRange heights = heightsBetween(layer, foot - reach, foot + cell + reach);
        if (heights.empty()) continue;
        const float most =
            layer.table.largestExtinction(heights.low, heights.high) * factor.most * (1 + kRounding);
        for (int k = 0; k < bounds.size.z; ++k) {
            const double z = foot.z + k * cell.z;
            if (z + cell.z + reach < heights.low - layer.below || z - reach > heights.high + layer.above)
                continue;
            bounds.cells[(static_cast<std::size_t>(k) * bounds.size.y + j) * bounds.size.x + i].most += most;
        }
    }
}

ExtinctionBounds boundsOfLayers(const Medium& medium) {
    ExtinctionBounds bounds;
    bounds.size = glm::ivec3(kColumns, kColumns, kLevels);
    bounds.extent = glm::dvec3(bounds.size);
    bounds.origin = medium.bounds().low;
    const glm::dvec3 extent = medium.bounds().high - medium.bounds().low;
    for (int a = 0; a < 3; ++a) bounds.cellsFromWay[a] = glm::dvec3(0.0);
    for (int a = 0; a < 3; ++a) bounds.cellsFromWay[a][a] = bounds.size[a] / extent[a];
    bounds.cells.resize(static_cast<std::size_t>(bounds.size.x) * bounds.size.y * bounds.size.z);
    parallelFor(bounds.size.y, [&](int j) {
        for (int i = 0; i < bounds.size.x; ++i) fillColumn(medium, i, j, bounds);
    });
    return bounds;
}

}  // namespace

ExtinctionBounds makeExtinctionBounds(const Medium& medium) {
    if (medium.bounds().empty()) return {};
    return medium.field() ? boundsOfField(medium) : boundsOfLayers(medium);
}

ExtinctionBounds coarseBounds(const ExtinctionBounds& bounds, float factor) {
    ExtinctionBounds coarse = bounds;
    float most = 0;
    for (const ExtinctionRange& cell : bounds.cells) most = std::max(most, cell.most);
    std::fill(coarse.cells.begin(), coarse.cells.end(), ExtinctionRange{0, most * factor});
    return coarse;
}

}  // namespace stereonav
