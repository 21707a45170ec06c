#include "terrain/tiles/tile_maker.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/placed_file.h"
#include "terrain/ground/level_step.h"
#include "terrain/tiles/tile_file.h"

namespace stereonav {
namespace {

// The file, open to be written at any place.
class TileWriter {
public:
    TileWriter(const std::filesystem::path& file, std::uint64_t bytes)
        : mName(file.string()), mOut(file, PlacedFile::For::Writing) {
        check(mOut.error());
        check(mOut.reserve(bytes));
    }

    void write(std::uint64_t at, const void* data, std::size_t bytes) const {
        check(mOut.write(at, data, bytes));
    }

private:
    void check(int number) const {
        if (number != 0)
            throw Error(mName, "tiles", std::string("cannot be written: ") + std::strerror(number),
                        "make room, or give another folder");
    }

    std::string mName;
    PlacedFile mOut;
};

// One level while it is made: rows that are still needed, and what the index will hold.
struct MadeLevel {
    TileFilePlan::Level plan;
    std::vector<float> rows;  // from `first` to `end` - 1
    int first = 0, end = 0;
    int tileRow = 0, blockRow = 0;  // next to be written; to be given bounds
    std::vector<float> bounds;
    std::vector<std::uint64_t> checks;

    explicit MadeLevel(const TileFilePlan::Level& of)
        : plan(of), bounds(of.blockCount()), checks(of.tileCount()) {}

    bool whole() const { return end == plan.size.y; }
    LevelRows view() const { return {rows.data(), plan.size, first}; }
    float* added(int count) {
        rows.resize(static_cast<std::size_t>(end + count - first) * plan.size.x);
        end += count;
        return rows.data() + static_cast<std::size_t>(end - count - first) * plan.size.x;
    }
    void dropBefore(int row) {
        row = std::min(row, end);
        if (row <= first) return;
        rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(row - first) * plan.size.x);
        first = row;
    }
};

class TileMaking {
public:
    TileMaking(const TileSource& source, const std::filesystem::path& file)
        : mSource(source), mPlan(source.size), mWriter(file, mPlan.byteCount()) {
        for (const TileFilePlan::Level& level : mPlan.levels()) mLevels.emplace_back(level);
    }

    void run(Progress& progress) {
        MadeLevel& finest = mLevels.front();
        const int rows = finest.plan.size.y;
        while (!finest.whole()) {
            progress.report(double(finest.end) / rows, "making tiles");
            const int wanted = finest.end == 0 && mSource.firstRows > 0 ? mSource.firstRows : mSource.rows;
            const int from = finest.end, count = std::min(std::max(wanted, 1), rows - from);
            float* const heights = finest.added(count);
            mSource.read(from, count, heights);
            tally(heights, count);
            advance(0);
        }
        writeIndex();
        progress.report(1, "making tiles");
    }

private:
    void tally(const float* heights, int count) {
        struct Row {
            float low = std::numeric_limits<float>::infinity(), high = -low;
            std::int64_t missing = 0;
        };
        std::vector<Row> found(static_cast<std::size_t>(count));
        const int width = mSource.size.x;
        parallelFor(count, [&](int k) {
            Row row;
            const float* const from = heights + static_cast<std::ptrdiff_t>(k) * width;
            for (int i = 0; i < width; ++i) {
                row.low = std::min(row.low, from[i]), row.high = std::max(row.high, from[i]);  // not a NaN
                row.missing += std::isfinite(from[i]) ? 0 : 1;
            }
            found[k] = row;
        });
        for (const Row& row : found) {
            mHead.low = std::min(mHead.low, row.low), mHead.high = std::max(mHead.high, row.high);
            mHead.missing += row.missing;
        }
    }

    // Does what the rows of this level, and of the one below it, are there for.
    void advance(std::size_t number) {
        MadeLevel& level = mLevels[number];
        writeTiles(level);
        if (number > 0) boundBlocks(mLevels[number - 1], level);
        const bool last = number + 1 == mLevels.size();
        if (!last) {
            makeCoarser(level, mLevels[number + 1]);
            advance(number + 1);
        }
        int needed = level.tileRow * kTileSide;
        if (number > 0) needed = std::min(needed, level.blockRow * kLevelBlock);
        if (!last)
            needed = std::min(
                {needed, mLevels[number + 1].blockRow * 2 * kLevelBlock, 2 * mLevels[number + 1].end - 1});
        level.dropBefore(level.whole() && last ? level.end : std::max(needed, 0));
    }

    void makeCoarser(const MadeLevel& finer, MadeLevel& coarser) const {
        const int known = finer.whole() ? coarser.plan.size.y : finer.end / 2;  // row j reads up to 2j + 1
        const int from = coarser.end, count = known - from;
        if (count <= 0) return;
        float* const heights = coarser.added(count);
        const LevelRows rows = finer.view();
        parallelFor(count, [&](int k) {
            coarserRow(rows, from + k, heights + static_cast<std::ptrdiff_t>(k) * coarser.plan.size.x);
        });
    }

    void boundBlocks(const MadeLevel& finer, MadeLevel& coarser) const {
        const glm::ivec2 size = coarser.plan.size, blocks = coarser.plan.blocks;
        for (; coarser.blockRow < blocks.y; ++coarser.blockRow) {
            const int last = std::min((coarser.blockRow + 1) * kLevelBlock, size.y - 1);
            if (coarser.end <= last || finer.end <= 2 * last) return;
            const LevelRows fine = finer.view(), made = coarser.view();
            parallelFor(blocks.x, [&](int i) {
                const glm::ivec2 block(i, coarser.blockRow);
                coarser.bounds[static_cast<std::size_t>(block.y) * blocks.x + i] = boundOfBlock(
                    blockDifference(fine, made, block), finer.bounds.data(), finer.plan.blocks, block);
            });
        }
    }

    void writeTiles(MadeLevel& level) const {
        const TileFilePlan::Level& plan = level.plan;
        while (level.tileRow < plan.tiles.y) {
            const int from = level.tileRow * kTileSide, to = std::min(from + kTileSide, plan.size.y);
            if (level.end < to) return;
            const LevelRows rows = level.view();
            parallelFor(plan.tiles.x, [&](int i) {
                thread_local std::vector<float> tile;
                tile.assign(static_cast<std::size_t>(kTileSide) * kTileSide,
                            std::numeric_limits<float>::quiet_NaN());
                const int x = i * kTileSide, width = std::min(kTileSide, plan.size.x - x);
                for (int j = from; j < to; ++j)
                    std::copy_n(rows.row(j) + x, width,
                                tile.data() + static_cast<std::size_t>(j - from) * kTileSide);
                const std::size_t number = static_cast<std::size_t>(level.tileRow) * plan.tiles.x + i;
                level.checks[number] = checkOf(tile.data(), kTileBytes);
                mWriter.write(plan.data + kTileBytes * number, tile.data(), kTileBytes);
            });
            ++level.tileRow;
        }
    }

    void writeIndex() {
        std::vector<char> index(mPlan.indexEnd() - sizeof mHead);
        for (const MadeLevel& level : mLevels) {
            std::memcpy(index.data() + (level.plan.checks - sizeof mHead), level.checks.data(),
                        level.checks.size() * sizeof level.checks[0]);
            std::memcpy(index.data() + (level.plan.bounds - sizeof mHead), level.bounds.data(),
                        level.bounds.size() * sizeof level.bounds[0]);
        }
        mHead.content = mSource.content;
        mHead.width = mSource.size.x, mHead.height = mSource.size.y;
        mHead.indexCheck = checkOf(index.data(), index.size());
        mHead.check = checkOf(mHead);
        mWriter.write(sizeof mHead, index.data(), index.size());
        mWriter.write(0, &mHead, sizeof mHead);
    }

    const TileSource& mSource;
    TileFilePlan mPlan;
    TileWriter mWriter;
    std::vector<MadeLevel> mLevels;
    TileFileHead mHead = [] {
        TileFileHead head;
        head.low = std::numeric_limits<float>::infinity(), head.high = -head.low;
        return head;
    }();
};

}  // namespace

// Bytes held of level k: a run of rows, those of a row of tiles and of blocks; twice, as they are moved when
// they grow.
double bytesOfMaking(const glm::ivec2& size, int rows) {
    const double heldRows = rows + kTileSide + 3.0 * kLevelBlock, kAllLevels = 2, kMoved = 2;
    return kMoved * kAllLevels * sizeof(float) * heldRows * size.x;
}

void makeTiles(const TileSource& source, const std::filesystem::path& file, Progress& progress) {
    TileMaking(source, file).run(progress);
}

}  // namespace stereonav
