#include "terrain/tiles/tile_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr std::uint64_t kHeadBytes = sizeof(TileFileHead);
constexpr const char* kMakeAgain = "remove the file: it is made again";

}  // namespace

TileStore::TileStore(const std::filesystem::path& file, std::uint64_t content)
    : mFile(file), mIn(file, PlacedFile::For::Reading) {
    const auto refuse = [&](const std::string& problem) {
        throw Error(file.string(), "tiles", problem, kMakeAgain);
    };
    if (mIn.error() != 0) refuse(std::string("cannot be opened: ") + std::strerror(mIn.error()));
    if (mIn.read(0, &mHead, sizeof mHead) != 0 || mHead.magic != TileFileHead().magic ||
        mHead.check != checkOf(mHead) || mHead.width < 2 || mHead.height < 2)
        refuse("expected a store of tiles, found something else");
    if (mHead.content != content) refuse("the tiles are of other heights");
    mPlan = TileFilePlan({mHead.width, mHead.height});
    std::error_code failed;
    const std::uint64_t bytes = std::filesystem::file_size(file, failed);
    if (failed || bytes != mPlan.byteCount())
        refuse(fmt::format("expected {} bytes, got {}", mPlan.byteCount(), failed ? 0 : bytes));
    std::vector<char> index(mPlan.indexEnd() - sizeof mHead);
    if (mIn.read(sizeof mHead, index.data(), index.size()) != 0 ||
        checkOf(index.data(), index.size()) != mHead.indexCheck)
        refuse("the index of the tiles is damaged");
    for (const TileFilePlan::Level& level : mPlan.levels()) {
        const auto part = [&](auto& to, std::uint64_t at, std::size_t count) {
            to.resize(count);
            std::memcpy(to.data(), index.data() + (at - kHeadBytes), count * sizeof to[0]);
        };
        part(mChecks.emplace_back(), level.checks, level.tileCount());
        part(mBounds.emplace_back(), level.bounds, level.blockCount());
    }
}

void TileStore::readTile(int level, const glm::ivec2& tile, float* heights) const {
    const TileFilePlan::Level& of = mPlan.levels()[level];
    const std::size_t number = static_cast<std::size_t>(tile.y) * of.tiles.x + tile.x;
    const auto place = [&] { return fmt::format("tile {}, {} of level {}", tile.x, tile.y, level); };
    if (mIn.read(of.data + kTileBytes * number, heights, kTileBytes) != 0)
        throw Error(mFile.string(), place(), "cannot be read", kMakeAgain);
    if (checkOf(heights, kTileBytes) != mChecks[level][number])
        throw Error(mFile.string(), place(), "is damaged", kMakeAgain);
}

void TileStore::read(int level, const glm::ivec2& low, const glm::ivec2& size, float* heights) const {
    const glm::ivec2 first = low / kTileSide, last = (low + size - 1) / kTileSide, tiles = last - first + 1;
    parallelFor(tiles.x * tiles.y, [&](int n) {
        const glm::ivec2 tile = first + glm::ivec2(n % tiles.x, n / tiles.x);
        thread_local std::vector<float> samples;
        samples.resize(static_cast<std::size_t>(kTileSide) * kTileSide);
        readTile(level, tile, samples.data());
        const glm::ivec2 origin = tile * kTileSide;
        const int i0 = std::max(low.x, origin.x), i1 = std::min(low.x + size.x, origin.x + kTileSide),
                  j0 = std::max(low.y, origin.y), j1 = std::min(low.y + size.y, origin.y + kTileSide);
        for (int j = j0; j < j1; ++j)
            std::copy_n(
                samples.data() + static_cast<std::ptrdiff_t>(j - origin.y) * kTileSide + i0 - origin.x,
                i1 - i0, heights + static_cast<std::ptrdiff_t>(j - low.y) * size.x + (i0 - low.x));
    });
}

}  // namespace stereonav
