// The file: a head, then records of bands, each with its own hash, so that it is whole at any time but for a
// last record that a power cut or a kill left unfinished.
#include "terrain/light/terrain_bake_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/stop.h"

namespace stereonav {
namespace {

constexpr char kPartMagic[8] = {'S', 'N', 'T', 'P', 'A', 'R', 'T', '2'};

struct PartHeader {
    char magic[8] = {};
    std::uint64_t key = 0;
};

struct RecordHeader {
    std::uint64_t bytes = 0, hash = 0;
    BakeBand band;
    std::int32_t unused = 0;
};

std::uint64_t bytesIn(const BakeBlocks& blocks) {
    std::uint64_t all = 0;
    for (const auto& block : blocks) all += block.size();
    return all;
}

std::uint64_t hashOf(const BakeBand& band, const BakeBlocks& blocks) {
    Hash hash;
    hash.add(std::int64_t{band.phase}).add(std::int64_t{band.first}).add(std::int64_t{band.rows});
    for (const auto& block : blocks) hash.add(block.data(), block.size());
    return hash.value();
}

template <typename T>
void writeOf(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename T>
bool readOf(std::istream& in, T& value) {
    return static_cast<bool>(in.read(reinterpret_cast<char*>(&value), sizeof value));
}

void writeRecord(std::ostream& out, const BakeBand& band, const BakeBlocks& blocks) {
    writeOf(out, RecordHeader{bytesIn(blocks), hashOf(band, blocks), band});
    for (const auto& block : blocks)
        out.write(reinterpret_cast<const char*>(block.data()), static_cast<std::streamsize>(block.size()));
}

void startPart(const std::filesystem::path& file, std::uint64_t key, const BakeBand& band,
               const BakeBlocks& blocks) {
    PendingFile pending(file);
    std::ofstream out(pending.temporary(), std::ios::binary);
    PartHeader header;
    std::memcpy(header.magic, kPartMagic, sizeof kPartMagic);
    header.key = key;
    writeOf(out, header);
    writeRecord(out, band, blocks);
    out.close();
    if (!out) throw Error(file.string(), "", "can not be written", "check the room on the disk");
    pending.finish(Flush::ToSystem);  // who stops does not want to wait
}

void addToPart(const std::filesystem::path& file, std::uint64_t after, const BakeBand& band,
               const BakeBlocks& blocks) {
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(static_cast<std::streamoff>(after));
    writeRecord(out, band, blocks);
    out.close();
    if (!out) throw Error(file.string(), "", "can not be written", "check the room on the disk");
}

// The band that may come next: further rows of the phase, or the first ones of the next.
bool follows(const BakeBand& band, const BakeReached& reached, std::int32_t rows, std::int32_t phases) {
    if (band.rows <= 0 || band.first < 0 || band.rows > rows - band.first || band.phase >= phases)
        return false;
    if (band.phase == reached.phase) return band.first == reached.rows;
    return reached.rows == rows && band.phase == reached.phase + 1 && band.first == 0;
}

}  // namespace

std::filesystem::path terrainBakePart(std::uint64_t key) {
    return keptFile(fmt::format("terrain-bake-{:016x}.bin", key));
}

std::uint64_t keepBakeBand(std::uint64_t key, std::uint64_t after, const BakeBand& band,
                           const BakeBlocks& blocks) {
    const bool is = keep(terrainBakePart(key), [&](const std::filesystem::path& file) {
        if (after == 0)
            startPart(file, key, band, blocks);
        else
            addToPart(file, after, band, blocks);
    });
    if (!is) return 0;
    return (after == 0 ? sizeof(PartHeader) : after) + sizeof(RecordHeader) + bytesIn(blocks);
}

BakeKept readBakePart(std::uint64_t key, std::int32_t rows, std::int32_t phases, const BlocksOfBand& begin) {
    BakeKept kept;
    std::ifstream in(terrainBakePart(key), std::ios::binary);
    PartHeader header;
    if (!in || !readOf(in, header) || std::memcmp(header.magic, kPartMagic, sizeof kPartMagic) != 0 ||
        header.key != key)
        return kept;
    std::uint64_t at = sizeof header;
    for (RecordHeader record; readOf(in, record) && follows(record.band, kept.reached, rows, phases);) {
        throwIfStopped();
        const BakeBlocks blocks = begin(record.band);
        bool whole = record.bytes == bytesIn(blocks);
        for (const auto& block : blocks)
            whole = whole && in.read(reinterpret_cast<char*>(block.data()),
                                     static_cast<std::streamsize>(block.size()));
        if (!whole || hashOf(record.band, blocks) != record.hash) {
            for (const auto& block : blocks) std::fill(block.begin(), block.end(), std::byte{0});
            break;
        }
        at += sizeof record + record.bytes;
        kept = {{record.band.phase, record.band.first + record.band.rows}, at};
    }
    return kept;
}

}  // namespace stereonav
