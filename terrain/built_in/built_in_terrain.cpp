// Generates the terrain or takes it from the cache: one file a seed and size, a small header with
// sizes and a content hash, then the heights and the colour rows as they lie in memory.
#include "terrain/built_in/built_in_terrain.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "engine/base/cache.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "terrain/built_in/built_in_color.h"
#include "terrain/built_in/built_in_relief.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// Raised whenever the generator's result changes.
constexpr std::uint32_t kVersion = 2;

struct Header {
    char magic[8] = {'S', 'N', 'T', 'E', 'R', 'R', 'A', '\n'};
    std::uint32_t version = kVersion;
    std::uint32_t size = 0;
    std::uint64_t seed = 0;
    double spacing = 0;
    std::uint64_t contentHash = 0;
};
static_assert(sizeof(Header) == 40);

std::size_t heightBytes(int size) {
    return sizeof(float) * static_cast<std::size_t>(size) * size;
}
std::size_t rowBytes(int size) {
    return sizeof(PackedColor) * kBuiltInTexels * static_cast<std::size_t>(size);
}

std::uint64_t contentHash(const BuiltInTerrain& terrain) {
    Hash hash;
    hash.add(terrain.heights.data(), heightBytes(terrain.size));
    for (int y = 0; y < terrain.color.height(); ++y) hash.add(terrain.color.row(y), rowBytes(terrain.size));
    return hash.value();
}

Header headerOf(const BuiltInTerrain& terrain, std::uint64_t seed) {
    Header header;
    header.size = static_cast<std::uint32_t>(terrain.size);
    header.seed = seed;
    header.spacing = terrain.spacing;
    header.contentHash = contentHash(terrain);
    return header;
}

fs::path cacheFile(std::uint64_t seed, int size) {
    return keptFile(fmt::format("terrain-v{}-{}-{:016x}.bin", kVersion, size, seed));
}

// nullopt when there is none, or it is not whole.
std::optional<BuiltInTerrain> readCache(const fs::path& file, std::uint64_t seed, int size) {
    std::error_code code;
    const std::uintmax_t expected =
        sizeof(Header) + heightBytes(size) + rowBytes(size) * kBuiltInTexels * size;
    if (fs::file_size(file, code) != expected || code) return std::nullopt;
    std::ifstream in(file, std::ios::binary);
    Header header;
    in.read(reinterpret_cast<char*>(&header), sizeof header);
    if (!in) return std::nullopt;
    BuiltInTerrain terrain;
    terrain.size = size;
    terrain.spacing = header.spacing;
    terrain.heights.resize(static_cast<std::size_t>(size) * size);
    in.read(reinterpret_cast<char*>(terrain.heights.data()), static_cast<std::streamsize>(heightBytes(size)));
    terrain.color.resize(kBuiltInTexels * size, kBuiltInTexels * size);
    for (int y = 0; y < terrain.color.height(); ++y)
        in.read(reinterpret_cast<char*>(terrain.color.row(y)), static_cast<std::streamsize>(rowBytes(size)));
    const Header whole = headerOf(terrain, seed);
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the bytes have to be equal, and none is padding.
    if (!in || std::memcmp(&header, &whole, sizeof header) != 0) return std::nullopt;
    noteUse(file);
    return terrain;
}

// The cache only saves time: where it can not be written the terrain is made again next time.
void writeCache(const fs::path& file, const BuiltInTerrain& terrain, std::uint64_t seed) {
    const Header header = headerOf(terrain, seed);
    const auto write = [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out.write(reinterpret_cast<const char*>(&header), sizeof header);
        out.write(reinterpret_cast<const char*>(terrain.heights.data()),
                  static_cast<std::streamsize>(heightBytes(terrain.size)));
        for (int y = 0; y < terrain.color.height(); ++y)
            out.write(reinterpret_cast<const char*>(terrain.color.row(y)),
                      static_cast<std::streamsize>(rowBytes(terrain.size)));
        out.close();
        if (!out) throw Error(file.string(), "", "can not be written", "check the room on the disk");
    };
    keep(file, [&](const fs::path& place) { writeFileAtomically(place, write); });
}

void checkSize(int size) {
    if (size < kBuiltInSizeMin || size > kBuiltInSizeMax)
        throw Error("built-in terrain", "size",
                    fmt::format("expected {} to {} samples, got {}", kBuiltInSizeMin, kBuiltInSizeMax, size),
                    "513 is a good size");
}

}  // namespace

BuiltInTerrain generateBuiltInTerrain(std::uint64_t seed, int size, Progress& progress,
                                      const std::optional<TerrainLook>& look) {
    checkSize(size);
    Progress shaping(progress, 0, 0.6), painting(progress, 0.6, 1);
    const Relief relief = makeRelief(seed, size, shaping);
    BuiltInTerrain terrain;
    terrain.size = size;
    terrain.spacing = static_cast<double>(kBuiltInExtent) / (size - 1);
    terrain.color = makeBuiltInColor(relief, seed, look ? &*look : nullptr, painting);
    terrain.heights = relief.heights;
    return terrain;
}

BuiltInTerrain builtInTerrain(std::uint64_t seed, int size, Progress& progress) {
    checkSize(size);
    const fs::path file = cacheFile(seed, size);
    progress.report(0, "reading the ground");
    if (auto cached = readCache(file, seed, size)) {
        progress.report(1, "reading the ground");
        return std::move(*cached);
    }
    BuiltInTerrain terrain = generateBuiltInTerrain(seed, size, progress);
    writeCache(file, terrain, seed);
    return terrain;
}

}  // namespace stereonav
