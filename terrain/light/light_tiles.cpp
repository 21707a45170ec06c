#include "terrain/light/light_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/memory.h"
#include "terrain/ground/level_step.h"

namespace stereonav {
namespace {

constexpr std::array<char, 8> kFineMagic{'S', 'N', 'F', 'I', 'N', 'E', 'L', '1'};
constexpr const char* kBakeFinerAgain = "bake it again with stereonav bake --resolution, or remove the file";

struct Head {
    std::array<char, 8> magic{};
    std::uint64_t key = 0;
    std::int32_t width = 0, height = 0, coarsest = 0, finest = 0;
    std::uint64_t content = 0;
    std::uint64_t check = 0;  // check value of what is before
};

std::uint64_t tileCheck(const void* data, std::size_t bytes) {
    return std::max<std::uint64_t>(Hash().add(data, bytes).value(), 2);
}

Head headOf(const FineLightShape& shape) {
    Head head;
    head.magic = kFineMagic;
    head.key = shape.key;
    head.width = shape.size.x, head.height = shape.size.y;
    head.coarsest = shape.coarsest, head.finest = shape.finest;
    head.content = shape.content;
    head.check = tileCheck(&head, offsetof(Head, check));
    return head;
}

std::size_t bytesASample(const TerrainLightSettings& settings) {
    if (settings.kind == TerrainLightKind::Openness) return 1;
    return 1 + settings.azimuths + 2 * sizeof(std::int16_t) * lightHarmonics(settings.order);
}

// Zeros where there is less.
Head headIn(const std::filesystem::path& file) {
    Head head;
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) return {};  // a pipe would be waited for
    std::ifstream in(file, std::ios::binary);
    if (in.read(reinterpret_cast<char*>(&head), sizeof head)) return head;
    if (in.bad()) throw DiskError(file.string());
    return {};
}

// Returns the shape with the finest level of the file, where it is a file of finer light.
FineLightShape asFineAs(const std::filesystem::path& file, FineLightShape shape) {
    checkFileToRead(file);
    const Head head = headIn(file);
    if (head.magic == kFineMagic) shape.finest = std::clamp(head.finest, 0, shape.coarsest);
    return shape;
}

// The planes of a tile as they follow one another.
template <typename Light, typename Each>
void eachPlane(Light& light, const Each& each) {
    each(light.openness);
    each(light.horizon);
    each(light.full);
    each(light.bounced);
}

}  // namespace

std::filesystem::path fineLightPlace(const std::filesystem::path& light) {
    std::filesystem::path place = light;
    return place += ".fine";
}

bool isFineLight(const std::filesystem::path& file) {
    return headIn(file).magic == kFineMagic;
}

bool isFineLightOf(const std::filesystem::path& file, std::uint64_t key) {
    const Head head = headIn(file);
    return head.magic == kFineMagic && head.key == key;
}

std::vector<std::byte> bytesOf(const TerrainLight& tile) {
    std::vector<std::byte> bytes;
    bytes.reserve(tile.byteCount());
    eachPlane(tile, [&](const auto& plane) {
        const auto of = std::as_bytes(std::span(plane));
        bytes.insert(bytes.end(), of.begin(), of.end());
    });
    return bytes;
}

LightTiles::LightTiles(const std::filesystem::path& file, const FineLightShape& shape, PlacedFile::For what)
    : mFile(file), mShape(shape), mPlaced(file, what) {
    glm::ivec2 size = shape.size;
    for (int level = 0; level <= shape.coarsest; ++level, size = coarserSize(size))
        if (level >= shape.finest) mLevels.push_back({size, (size + kLightTileSide - 1) / kLightTileSide, 0});
    std::reverse(mLevels.begin(), mLevels.end());
    std::size_t tiles = 0;
    for (Level& level : mLevels) {
        level.first = tiles;
        tiles += static_cast<std::size_t>(level.tiles.x) * level.tiles.y;
    }
    mChecks.assign(tiles, kNotThere);
    mAt.push_back(sizeof(Head) + sizeof(std::uint64_t) * tiles);
    for (std::size_t n = 0; n < tiles; ++n) {
        const glm::ivec2 of = sizeOf(tile(n));
        mAt.push_back(mAt.back() + bytesASample(shape.settings) * static_cast<std::size_t>(of.x) * of.y);
    }
}

LightTiles::LightTiles(const std::filesystem::path& file, const FineLightShape& shape)
    : LightTiles(file, asFineAs(file, shape), PlacedFile::For::Reading) {
    std::error_code failed;
    if (mPlaced.error() != 0 && std::filesystem::exists(file, failed)) throw DiskError(file.string());
    if (mPlaced.error() != 0) refuse("", std::string("cannot be opened: ") + std::strerror(mPlaced.error()));
    if (!isFineLight(file)) refuse("", "expected light at finer samples, found something else");
    if (!readIndex()) refuse("", "is of another bake, or of other ground, than the light beside it");
    const std::uintmax_t bytes = std::filesystem::file_size(file, failed);
    if (failed || bytes != byteCount())
        refuse("", fmt::format("expected {} bytes, found {}: cut off or damaged", byteCount(),
                               failed ? 0 : bytes));
    for (std::size_t n = 0; n < count(); ++n)
        if (!has(n)) refuse("", "lacks tiles: the file is damaged");
}

LightTiles LightTiles::begin(const std::filesystem::path& file, const FineLightShape& shape) {
    LightTiles tiles(file, shape, PlacedFile::For::GoingOn);
    tiles.checkWritten(tiles.mPlaced.error());
    std::error_code failed;
    const bool there =
        std::filesystem::file_size(file, failed) == tiles.byteCount() && !failed && tiles.readIndex();
    if (there) {
        // After a power cut what was noted as written may not be.
        for (std::size_t n = 0; n < tiles.count(); ++n)
            if (tiles.has(n) && tiles.mChecks[n] != kNothing && tiles.bytesAt(n).empty())
                tiles.mChecks[n] = kNotThere;
        return tiles;
    }
    tiles.mPlaced = PlacedFile(file, PlacedFile::For::Writing);
    tiles.checkWritten(tiles.mPlaced.error());
    const int full = tiles.mPlaced.reserve(tiles.byteCount());
    if (full != 0) std::filesystem::remove(file, failed);
    tiles.checkWritten(full);
    tiles.mChecks.assign(tiles.count(), kNotThere);
    const Head head = headOf(shape);
    tiles.checkWritten(tiles.mPlaced.write(0, &head, sizeof head));
    return tiles;
}

bool LightTiles::readIndex() {
    Head head;
    const Head wanted = headOf(mShape);
    return isRead(mPlaced.read(0, &head, sizeof head)) && std::memcmp(&head, &wanted, sizeof head) == 0 &&
           isRead(mPlaced.read(sizeof head, mChecks.data(), sizeof(std::uint64_t) * mChecks.size()));
}

bool LightTiles::isRead(int error) const {
    if (error != 0 && error != ENODATA) throw DiskError(mFile.string());
    return error == 0;
}

void LightTiles::refuse(const std::string& place, const std::string& problem) const {
    throw Error(mFile.string(), place, problem, kBakeFinerAgain);
}

void LightTiles::checkWritten(int error) const {
    if (error != 0)
        throw Error(mFile.string(), "", std::string("cannot be written: ") + std::strerror(error),
                    fmt::format("it takes {}; give another place with --out, or a smaller --resolution",
                                memoryText(static_cast<double>(byteCount()))));
}

LightTiles::Tile LightTiles::tile(std::size_t n) const {
    std::size_t of = mLevels.size() - 1;
    while (mLevels[of].first > n) --of;
    const int number = static_cast<int>(n - mLevels[of].first), across = mLevels[of].tiles.x;
    return {mShape.coarsest - static_cast<int>(of), {number % across, number / across}};
}

std::size_t LightTiles::numberOf(const Tile& tile) const {
    const Level& level = mLevels[mShape.coarsest - tile.level];
    return level.first + static_cast<std::size_t>(tile.number.y) * level.tiles.x + tile.number.x;
}

glm::ivec2 LightTiles::sizeOf(const Tile& tile) const {
    return glm::min(size(tile.level) - tile.low(), glm::ivec2(kLightTileSide));
}

std::vector<std::byte> LightTiles::bytesAt(std::size_t n) const {
    std::vector<std::byte> bytes(mAt[n + 1] - mAt[n]);
    if (!isRead(mPlaced.read(mAt[n], bytes.data(), bytes.size())) ||
        tileCheck(bytes.data(), bytes.size()) != mChecks[n])
        return {};
    return bytes;
}

bool LightTiles::isWhole() const {
    for (std::size_t n = 0; n < count(); ++n)
        if (mChecks[n] != kNothing && bytesAt(n).empty()) return false;
    return true;
}

std::optional<TerrainLight> LightTiles::read(const Tile& tile) const {
    const std::size_t n = numberOf(tile);
    if (mChecks[n] == kNothing) return std::nullopt;
    const std::vector<std::byte> bytes = bytesAt(n);
    if (bytes.empty())
        refuse(fmt::format("tile {}, {} of level {}", tile.number.x, tile.number.y, tile.level),
               "cannot be read, or is damaged");
    TerrainLight light;
    light.settings = mShape.settings;
    light.settings.stride = 1;
    light.grid = LightGrid(glm::ivec2(0), sizeOf(tile));
    const std::size_t samples = light.grid.count();
    light.openness.resize(samples);
    if (light.settings.kind == TerrainLightKind::Transfer) {
        light.horizon.resize(samples * light.settings.azimuths);
        light.full.resize(samples * lightHarmonics(light.settings.order));
        light.bounced.resize(light.full.size());
    }
    const std::byte* from = bytes.data();
    eachPlane(light, [&](auto& plane) {
        const auto to = std::as_writable_bytes(std::span(plane));
        std::copy_n(from, to.size(), to.begin());
        from += to.size();
    });
    return light;
}

void LightTiles::write(std::size_t n, std::span<const std::byte> bytes) {
    if (!bytes.empty()) checkWritten(mPlaced.write(mAt[n], bytes.data(), bytes.size()));
    // After it: a tile that is begun is not there.
    mChecks[n] = bytes.empty() ? kNothing : tileCheck(bytes.data(), bytes.size());
    checkWritten(mPlaced.write(sizeof(Head) + sizeof(std::uint64_t) * n, &mChecks[n], sizeof mChecks[n]));
}

void LightTiles::finish(const std::filesystem::path& place) {
    checkWritten(mPlaced.toDisk());
    std::error_code failed;
    std::filesystem::rename(mFile, place, failed);
    // Another run of the same bake may have been first.
    if (failed && !(failed == std::errc::no_such_file_or_directory && isFineLight(place)))
        checkWritten(failed.value());
    mFile = place;
}

}  // namespace stereonav
