// The finished part of a terrain's bake: kept in the cache while it runs, band by band of rows, so that one
// that is stopped has next to nothing left to write, and the next run goes on from there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace stereonav {

// Rows of a phase that are done, from the first on. Phase 0: horizons and direct transfer; then one a bounce.
struct BakeReached {
    std::int32_t phase = 0, rows = 0;
};

// Rows of one phase, from `first` on.
struct BakeBand {
    std::int32_t phase = 0, first = 0, rows = 0;
};

// Memory of what a band holds, that is read into, or written.
using BakeBlocks = std::vector<std::span<std::byte>>;
using BlocksOfBand = std::function<BakeBlocks(const BakeBand&)>;

// Returns where the part of the bake with this key lies (terrainLightKey()).
std::filesystem::path terrainBakePart(std::uint64_t key);

// Adds a band to the part of the bake with this key, behind the `after` bytes that hold all before it.
// Returns the bytes that hold this one too; 0 where it can not be written. Bounded with what else is kept
// (engine/base/cache.h). Two runs of the same bake may do so at once: bytes are the same wherever both wrote
// the same bands, and what does not fit together is not read.
std::uint64_t keepBakeBand(std::uint64_t key, std::uint64_t after, const BakeBand& band,
                           const BakeBlocks& blocks);

// The part of a bake that lies in the cache.
struct BakeKept {
    BakeReached reached;
    std::uint64_t bytes = 0;  // from the start of the file, that hold it
};

// Reads what is kept of this bake: calls begin(band) for each band in turn, which follows what came before it
// (rows in order, then the next phase), and fills what it returns. Ends at the first that is damaged, cut off
// or not one of this bake's, whose memory it sets to 0.
// rows: of every phase. Throws Cancelled, as `begin` may.
BakeKept readBakePart(std::uint64_t key, std::int32_t rows, std::int32_t phases, const BlocksOfBand& begin);

}  // namespace stereonav
