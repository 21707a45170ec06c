#include "terrain/read/gdal/spread_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

constexpr float kNotThere = std::numeric_limits<float>::quiet_NaN();

// Samples of a coarse axis that lie in one block of the file.
struct BlockSpan {
    int block, first, count;  // samples from first on
};

// The file's sample nearest to the middle of a coarse one.
int sourceOf(int coarse, int coarseCount, int count) {
    return static_cast<int>((coarse + 0.5) * count / coarseCount);
}

std::vector<BlockSpan> spansOf(int coarseCount, int count, int blockSize) {
    std::vector<BlockSpan> spans;
    for (int n = 0; n < coarseCount; ++n) {
        const int block = sourceOf(n, coarseCount, count) / blockSize;
        if (spans.empty() || spans.back().block != block) spans.push_back({block, n, 0});
        ++spans.back().count;
    }
    return spans;
}

// Places of a grid in an order whose beginnings are spread evenly: those at multiples of a high power of two
// first, then the middles of their squares, the middles of their sides, and so on.
std::vector<glm::ivec2> spreadOrder(int columns, int rows) {
    struct Keyed {
        std::uint64_t key;
        glm::ivec2 place;
    };
    std::vector<Keyed> all;
    all.reserve(static_cast<std::size_t>(columns) * rows);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            std::uint64_t key = 0;
            for (int bit = 0; bit < 20; ++bit) {
                const std::uint64_t a = x >> bit & 1, b = y >> bit & 1;
                key = key << 2 | (a ^ b) << 1 | b;
            }
            all.push_back({key, {x, y}});
        }
    std::sort(all.begin(), all.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
    std::vector<glm::ivec2> order;
    order.reserve(all.size());
    for (const Keyed& one : all) order.push_back(one.place);
    return order;
}

class SpreadReading {
public:
    SpreadReading(HeightSamples& raster, GdalMessages& messages, const glm::ivec2& size)
        : mRaster(raster),
          mMessages(messages),
          mSize(size),
          mColumns(spansOf(size.x, raster.width(), raster.blockWidth())),
          mRows(spansOf(size.y, raster.height(), raster.blockHeight())),
          mHeights(static_cast<std::size_t>(size.x) * size.y, kNotThere),
          mRead(mHeights.size(), 0) {}

    // Returns false where the fewest take too long.
    bool read(double time_ms, double most_ms) {
        const Stopwatch watch;
        int count = 0;
        for (const glm::ivec2& place :
             spreadOrder(static_cast<int>(mColumns.size()), static_cast<int>(mRows.size()))) {
            throwIfStopped();
            readBlock(mColumns[static_cast<std::size_t>(place.x)], mRows[static_cast<std::size_t>(place.y)]);
            ++count;
            if (count >= kFewestSpread && watch.elapsed_ms() > time_ms) break;
            if (count < kFewestSpread && watch.elapsed_ms() > most_ms) return false;
        }
        return true;
    }

    std::vector<float> filled(const FillBetween& fill) {
        if (mRaster.findCustomary()) mRaster.dropCustomary(mHeights.data(), mHeights.size());
        if (std::find(mRead.begin(), mRead.end(), 0) == mRead.end()) return std::move(mHeights);
        std::vector<float> missing(mHeights.size(), kNotThere);
        for (std::size_t n = 0; n < missing.size(); ++n)
            if (mRead[n]) missing[n] = std::isnan(mHeights[n]) ? 1.f : 0.f;
        fill(missing, mSize.x, mSize.y);
        fill(mHeights, mSize.x, mSize.y);
        for (std::size_t n = 0; n < missing.size(); ++n)
            if (missing[n] > 0.5f) mHeights[n] = kNotThere;
        return std::move(mHeights);
    }

private:
    // A row of the block at a time, of which a few are needed: the block is decoded once.
    void readBlock(const BlockSpan& columns, const BlockSpan& rows) {
        const int west = columns.block * mRaster.blockWidth();
        const int width = std::min(mRaster.blockWidth(), mRaster.width() - west);
        mRow.resize(static_cast<std::size_t>(width));
        for (int j = rows.first; j < rows.first + rows.count; ++j) {
            const int row = sourceOf(j, mSize.y, mRaster.height());
            mRaster.read({west, row, width, 1}, mMessages, mRow.data());
            for (int i = columns.first; i < columns.first + columns.count; ++i) {
                const std::size_t at = static_cast<std::size_t>(j) * mSize.x + i;
                mHeights[at] = mRow[static_cast<std::size_t>(sourceOf(i, mSize.x, mRaster.width()) - west)];
                mRead[at] = 1;
            }
        }
    }

    HeightSamples& mRaster;
    GdalMessages& mMessages;
    glm::ivec2 mSize;
    std::vector<BlockSpan> mColumns, mRows;
    std::vector<float> mHeights, mRow;
    std::vector<unsigned char> mRead;
};

}  // namespace

bool hasBlocksAnywhere(GDALDataset& dataset) {
    const std::string_view driver = dataset.GetDriverName();
    return driver == "GTiff" || driver == "VRT";
}

std::vector<float> readSpreadBlocks(HeightSamples& raster, GdalMessages& messages, const glm::ivec2& size,
                                    double time_ms, double most_ms, const FillBetween& fill) {
    constexpr long long kMostOfBlock = 1 << 24;
    if (1ll * raster.blockWidth() * raster.blockHeight() > kMostOfBlock) return {};
    SpreadReading reading(raster, messages, size);
    if (!reading.read(time_ms, most_ms)) return {};
    return reading.filled(fill);
}

}  // namespace stereonav
