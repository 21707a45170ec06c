#include "terrain/terrain_bake_part.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"

namespace stereonav {
namespace {

constexpr char kPartMagic[8] = {'S', 'N', 'T', 'P', 'A', 'R', 'T', '1'};

struct PartHeader {
    char magic[8] = {};
    std::uint64_t key = 0, bytes = 0, hash = 0;
    BakeReached reached;
};

std::uint64_t bytesIn(const BakeBlocks& blocks) {
    std::uint64_t all = 0;
    for (const auto& block : blocks) all += block.size();
    return all;
}

std::uint64_t hashOf(const BakeBlocks& blocks) {
    Hash hash;
    for (const auto& block : blocks) hash.add(block.data(), block.size());
    return hash.value();
}

bool readHeader(std::ifstream& in, std::uint64_t key, PartHeader& header) {
    return in.read(reinterpret_cast<char*>(&header), sizeof header) &&
           std::memcmp(header.magic, kPartMagic, sizeof kPartMagic) == 0 && header.key == key;
}

}  // namespace

std::filesystem::path terrainBakePart(std::uint64_t key) {
    return keptFile(fmt::format("terrain-bake-{:016x}.bin", key));
}

bool keepBakePart(std::uint64_t key, const BakeReached& reached, const BakeBlocks& blocks) {
    PartHeader header;
    std::memcpy(header.magic, kPartMagic, sizeof kPartMagic);
    header.key = key;
    header.bytes = bytesIn(blocks);
    header.hash = hashOf(blocks);
    header.reached = reached;
    return keep(terrainBakePart(key), [&](const std::filesystem::path& file) {
        PendingFile pending(file);
        std::ofstream out(pending.temporary(), std::ios::binary);
        out.write(reinterpret_cast<const char*>(&header), sizeof header);
        for (const auto& block : blocks)
            out.write(reinterpret_cast<const char*>(block.data()),
                      static_cast<std::streamsize>(block.size()));
        out.close();
        if (!out) throw Error(file.string(), "", "can not be written", "check the room on the disk");
        pending.finish(Flush::ToSystem);  // who stops does not want to wait
    });
}

BakeReached keptBakePart(std::uint64_t key) {
    std::ifstream in(terrainBakePart(key), std::ios::binary);
    PartHeader header;
    return in && readHeader(in, key, header) ? header.reached : BakeReached{};
}

bool readBakePart(std::uint64_t key, const BakeBlocks& blocks) {
    std::ifstream in(terrainBakePart(key), std::ios::binary);
    PartHeader header;
    if (!in || !readHeader(in, key, header) || header.bytes != bytesIn(blocks)) return false;
    for (const auto& block : blocks)
        if (!in.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(block.size())))
            return false;
    return hashOf(blocks) == header.hash;
}

}  // namespace stereonav
