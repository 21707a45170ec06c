// Each tile of pixels passes a chunk of slabs with its gathered light in registers. Slabs where the medium's
// cells are empty are skipped; a tile ends when none of its rays goes on.
#include "engine/medium/sweep/sweep_eyes.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/medium/sweep/sweep_data.h"

namespace stereonav {
namespace {

constexpr int kSide = EyeTile::kSide;
constexpr std::size_t kTileNumbers = std::size_t{EyeTile::kMembers} * kSide * kSide;
constexpr std::size_t kLine = 64;  // bytes of a cache line, on which shared rows begin

float* alignedStart(std::vector<float>& numbers) {
    void* start = numbers.data();
    std::size_t space = numbers.size() * sizeof(float);
    return static_cast<float*>(std::align(kLine, kLine, start, space));
}

// Returns the number of tiles in a row that the first eye has to be ahead: the second eye's pixels read at
// most `farthest` columns farther right, between two pixels.
int tilesBehind(float farthest, int across) {
    const double tiles = std::floor((kSide + 1.0 + static_cast<double>(farthest)) / kSide);
    return static_cast<int>(std::clamp(tiles, 0.0, static_cast<double>(across)));
}

}  // namespace

void SweepEyes::Eye::start(const RayFan& fan) {
    across = (fan.width + kSide - 1) / kSide;
    down = (fan.height + kSide - 1) / kSide;
    const std::size_t tiles = static_cast<std::size_t>(across) * down;
    if (states.size() < tiles * kTileNumbers) states.resize(tiles * kTileNumbers);
    fresh.assign(tiles, 1);
    done.assign(tiles, 0);
    slabs.assign(4 * tiles, 0);
}

void SweepEyes::start(const SweepGeometry& geometry, const SweepSharing& sharing,
                      std::span<const Plane<float>> starts) {
    mGeometry = &geometry;
    mSharing = starts.empty() ? sharing : SweepSharing{};
    mStarts = starts;
    mEyes.resize(geometry.eyes.size());
    for (std::size_t eye = 0; eye < mEyes.size(); ++eye) {
        mEyes[eye].start(geometry.eyes[eye]);
        mEyes[eye].seen = sweepEye(geometry.eyes[eye], geometry);
        setBeams(eye);
    }
}

void SweepEyes::setBeams(std::size_t eye) {
    const SweepGeometry& g = *mGeometry;
    Eye& e = mEyes[eye];
    e.beams.resize(4 * static_cast<std::size_t>(e.tiles()));
    parallelFor(e.tiles(), [&](int tile) {
        for (int quarter = 0; quarter < 4; ++quarter) {
            constexpr double kHalf = EyeTile::kHalf;
            const int column = tile % e.across, right = quarter % 2;
            const int row = tile / e.across, lower = quarter / 2;
            const double x = column * kSide + right * kHalf, y = row * kSide + lower * kHalf;
            e.beams[4 * static_cast<std::size_t>(tile) + quarter] =
                mSpace.beamOf(g, g.eyes[eye], g.forward, x, y, x + kHalf, y + kHalf);
        }
    });
}

// Finds the chunk's slabs where a tile may meet something; returns the number of samples in them.
long long SweepEyes::findSlabs(Eye& eye, int tile, const Walk& walk) const {
    long long met = 0;
    for (std::size_t n = 4 * static_cast<std::size_t>(tile), end = n + 4; n < end; ++n) {
        eye.slabs[n] = mSpace.planesMet(eye.beams[n], walk.middles, walk.count);
        met += std::popcount(eye.slabs[n]);
    }
    return met * EyeTile::kHalf * EyeTile::kHalf;
}

EyeTile SweepEyes::tileOf(std::size_t eye, int n) const {
    const Eye& e = mEyes[eye];
    EyeTile tile;
    tile.x0 = n % e.across * kSide;
    tile.y0 = n / e.across * kSide;
    tile.fresh = e.fresh[n];
    for (std::size_t quarter = 0; quarter < 4; ++quarter)
        tile.slabs[quarter] = e.slabs[4 * static_cast<std::size_t>(n) + quarter];
    return tile;
}

long long SweepEyes::seeTile(std::size_t eye, int n, const Walk& walk) {
    Eye& e = mEyes[eye];
    if (e.done[n]) return 0;
    const long long samples = findSlabs(e, n, walk);
    if (samples == 0) return 0;
    EyeTile tile = tileOf(eye, n);
    tile.state = e.states.data() + n * kTileNumbers;
    if (!mStarts.empty()) {
        tile.starts = mStarts[eye].row(tile.y0) + tile.x0;
        tile.startStride = mStarts[eye].stride();
    }
    e.done[n] = !mKernels.seeTile(walk.scene, e.seen, walk.chunk, tile);
    e.fresh[n] = 0;
    return samples;
}

// Sees a row of tiles for both eyes, the second one sharing what the first one saw.
long long SweepEyes::seeRow(int row, const Walk& walk) {
    Eye &first = mEyes[0], &second = mEyes[1];
    const int begin = row * first.across, end = begin + first.across;
    long long samples = 0;
    std::uint32_t wanted[2] = {0, 0};  // slabs that the second eye reads in the upper and in the lower half
    for (int n = begin; n < end; ++n) {
        if (second.done[n]) continue;
        samples += findSlabs(second, n, walk);
        const std::uint32_t* slabs = second.slabs.data() + 4 * static_cast<std::size_t>(n);
        for (std::size_t half = 0; half < 2; ++half) wanted[half] |= slabs[2 * half] | slabs[2 * half + 1];
    }
    if (((wanted[0] | wanted[1]) & walk.shared.slabs) == 0) {
        samples = 0;
        for (int n = begin; n < end; ++n) samples += seeTile(0, n, walk) + seeTile(1, n, walk);
        return samples;
    }
    for (int n = begin; n < end; ++n) {
        const long long met = findSlabs(first, n, walk);
        if (!first.done[n]) samples += met;
    }
    RowTask task{row, walk.shared, std::vector<std::uint8_t>(2 * static_cast<std::size_t>(first.across))};
    const int behind = tilesBehind(walk.shared.farthest, first.across);
    std::unique_ptr<std::vector<float>> rows = takeRows();
    task.rows.numbers = alignedStart(*rows);
    for (task.firstRow = 0; task.firstRow < kSide; task.firstRow += SharedRows::kRows) {
        task.rows.slabs = walk.shared.slabs & wanted[task.firstRow / EyeTile::kHalf];
        // The second eye follows as soon as what it reads is there, while it is still in the cache.
        for (int n = begin; n < end + behind; ++n) {
            if (n < end) seeHalf(0, n, walk, task);
            if (n - behind >= begin) seeHalf(1, n - behind, walk, task);
        }
    }
    giveBack(std::move(rows));
    for (int n = begin; n < end; ++n)
        for (const std::size_t eye : {0, 1}) {
            if (!isSeen(eye, n)) continue;
            mEyes[eye].fresh[n] = 0;
            mEyes[eye].done[n] = !task.goesOn[2 * static_cast<std::size_t>(n - begin) + eye];
        }
    return samples;
}

// Returns whether a tile of a shared row has to be sampled: always for the first eye, which also marks empty
// slabs for the second.
bool SweepEyes::isSeen(std::size_t eye, int n) const {
    const std::uint32_t* slabs = mEyes[eye].slabs.data() + 4 * static_cast<std::size_t>(n);
    return eye == 0 || (!mEyes[eye].done[n] && (slabs[0] | slabs[1] | slabs[2] | slabs[3]) != 0);
}

// Samples one tile's half of the task's rows.
void SweepEyes::seeHalf(std::size_t eye, int n, const Walk& walk, RowTask& task) {
    Eye& e = mEyes[eye];
    if (task.row * kSide + task.firstRow >= e.seen.height || !isSeen(eye, n)) return;
    EyeTile tile = tileOf(eye, n);
    tile.state = e.states.data() + n * kTileNumbers;
    tile.firstRow = task.firstRow;
    tile.lastRow = task.firstRow + SharedRows::kRows;
    if (task.rows.slabs != 0) (eye == 0 ? tile.keeps : tile.reads) = &task.rows;
    std::uint8_t& goesOn = task.goesOn[2 * static_cast<std::size_t>(n - task.row * e.across) + eye];
    if (mKernels.seeTile(walk.scene, e.seen, walk.chunk, tile)) goesOn = 1;
}

// Returns memory for shared rows: there are as many blocks as tasks that run at the same time.
std::unique_ptr<std::vector<float>> SweepEyes::takeRows() {
    std::unique_ptr<std::vector<float>> rows;
    {
        const std::lock_guard lock(mRowsLock);
        if (!mRows.empty()) {
            rows = std::move(mRows.back());
            mRows.pop_back();
        }
    }
    if (!rows) rows = std::make_unique<std::vector<float>>();
    if (rows->size() < rowsNumbers()) rows->resize(rowsNumbers());
    return rows;
}

void SweepEyes::giveBack(std::unique_ptr<std::vector<float>> rows) {
    const std::lock_guard lock(mRowsLock);
    mRows.push_back(std::move(rows));
}

std::size_t SweepEyes::rowsNumbers() const {
    const std::size_t columns = static_cast<std::size_t>(mEyes[0].across) * kSide + SharedRows::kReadAhead;
    return columns * SweepChunk::kMost * SharedRows::kRows * SharedRows::kNumbers + kLine / sizeof(float);
}

long long SweepEyes::seeChunk(const SweepScene& scene, const SweepChunk& chunk, int first, int count) {
    Walk walk{scene, chunk, count, {}, {}};
    for (int n = 0; n < count; ++n)
        walk.middles[n] = 0.5 * (mGeometry->faces[first + n] + mGeometry->faces[first + n + 1]);
    walk.shared.slabs = mSharing.slabsOf(chunk, count, walk.shared);
    std::atomic<long long> samples = 0;
    if (walk.shared.slabs != 0) {
        walk.shared.columns = mEyes[0].across * kSide;
        parallelFor(mEyes[0].down, [&](int row) { samples += seeRow(row, walk); });
        return samples;
    }
    int total = 0;
    for (const Eye& e : mEyes) total += e.tiles();
    parallelFor(total, [&](int n) {
        std::size_t eye = 0;
        for (; n >= mEyes[eye].tiles(); ++eye) n -= mEyes[eye].tiles();
        samples += seeTile(eye, n, walk);
    });
    return samples;
}

void SweepEyes::dropPassed(SweepReach& reach) const {
    for (std::size_t eye = 0; eye < mEyes.size(); ++eye)
        for (int tile = 0; tile < mEyes[eye].tiles(); ++tile)
            if (mEyes[eye].done[tile]) reach.drop(eye, tile);
}

void SweepEyes::readPicture(std::size_t eye, MediumPicture& picture) const {
    const Eye& e = mEyes[eye];
    picture.light.resize(mGeometry->eyes[eye].width, mGeometry->eyes[eye].height);
    picture.viewDepth.resize(mGeometry->eyes[eye].width, mGeometry->eyes[eye].height);
    parallelFor(e.tiles(), [&](int n) {
        const int x0 = n % e.across * kSide, y0 = n / e.across * kSide;
        PictureTile tile;
        tile.light = &picture.light.row(y0)[x0].x;
        tile.depth = picture.viewDepth.row(y0) + x0;
        tile.lightStride = 4 * static_cast<std::int64_t>(picture.light.stride());
        tile.depthStride = picture.viewDepth.stride();
        tile.width = std::min(kSide, picture.light.width() - x0);
        tile.height = std::min(kSide, picture.light.height() - y0);
        if (!e.fresh[n]) {
            mKernels.readTile(e.states.data() + n * kTileNumbers, tile);
            return;
        }
        for (int y = 0; y < tile.height; ++y)
            for (int x = 0; x < tile.width; ++x) {
                picture.light.at(x0 + x, y0 + y) = glm::vec4(0, 0, 0, 1);
                picture.viewDepth.at(x0 + x, y0 + y) = kMissDepth;
            }
    });
}

std::size_t SweepEyes::heldBytes() const {
    std::size_t bytes = 0;
    for (const Eye& e : mEyes)
        bytes += e.states.size() * sizeof(float) + e.beams.size() * sizeof(SweepBeam) +
                 e.slabs.size() * sizeof(std::uint32_t);
    for (const auto& rows : mRows) bytes += rows->size() * sizeof(float);
    return bytes;
}

}  // namespace stereonav
