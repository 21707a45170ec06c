// Baked light in a file, little-endian: the header below, then openness, horizon, full and bounced as they
// lie in memory (their sizes follow from the header), then a 64-bit hash of all before.
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr char kMagic[8] = {'S', 'N', 'T', 'L', 'I', 'G', 'H', 'T'};
constexpr std::uint32_t kFileVersion = 1;
constexpr const char* kBakeAgain = "bake it again with stereonav bake";

struct LightHeader {
    char magic[8];
    std::uint32_t version, kind, order, bounces, rays, azimuths, stride, groundWidth, groundHeight, width,
        height, reserved;
    double albedo;
    std::uint64_t seed, key;
};
static_assert(sizeof(LightHeader) == 80);

LightHeader headerOf(const TerrainLight& light) {
    const TerrainLightSettings& s = light.settings;
    const auto u = [](int value) { return static_cast<std::uint32_t>(value); };
    LightHeader h{{},
                  kFileVersion,
                  static_cast<std::uint32_t>(s.kind),
                  u(s.order),
                  u(s.bounces),
                  u(s.rays),
                  u(s.azimuths),
                  u(s.stride),
                  u(light.grid.groundWidth),
                  u(light.grid.groundHeight),
                  u(light.grid.width),
                  u(light.grid.height),
                  0,
                  s.albedo,
                  s.seed,
                  light.key};
    std::memcpy(h.magic, kMagic, sizeof kMagic);
    return h;
}

// Bytes of the arrays that a header announces; 0 for what no bake writes.
struct Sizes {
    std::size_t samples = 0, horizon = 0, transfer = 0;  // elements
    std::size_t bytes() const { return samples + horizon + 4 * transfer; }
};

bool plausible(const LightHeader& h) {
    const auto side = [](std::uint32_t samples, std::uint32_t ground, std::uint32_t stride) {
        return ground >= 2 && ground <= 1u << 28 && samples == (ground - 2) / stride + 2;
    };
    return (h.kind == 1 || h.kind == 2) && h.order >= 1 && h.order <= kMaxHarmonicsOrder && h.bounces <= 4 &&
           h.azimuths >= 8 && h.azimuths <= 64 && h.stride >= 1 && h.stride <= 1u << 20 && h.albedo >= 0 &&
           h.albedo <= 1 && h.rays <= 65536 && side(h.width, h.groundWidth, h.stride) &&
           side(h.height, h.groundHeight, h.stride);
}

Sizes sizesOf(const LightHeader& h) {
    Sizes sizes;
    sizes.samples = static_cast<std::size_t>(h.width) * h.height;
    if (h.kind == static_cast<std::uint32_t>(TerrainLightKind::Openness)) return sizes;
    sizes.horizon = sizes.samples * h.azimuths;
    sizes.transfer = sizes.samples * lightHarmonics(static_cast<int>(h.order));
    return sizes;
}

template <typename T>
void addArray(Hash& hash, const std::vector<T>& values) {
    hash.add(values.data(), values.size() * sizeof(T));
}

std::uint64_t checksum(const LightHeader& h, const TerrainLight& light) {
    Hash hash;
    hash.add(&h, sizeof h);
    addArray(hash, light.openness);
    addArray(hash, light.horizon);
    addArray(hash, light.full);
    addArray(hash, light.bounced);
    return hash.value();
}

template <typename T>
void write(std::ostream& out, const std::vector<T>& values) {
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

template <typename T>
void read(std::istream& in, std::size_t count, std::vector<T>& values) {
    values.resize(count);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

TerrainLight emptyLight(const LightHeader& h) {
    TerrainLight light;
    const auto i = [](std::uint32_t value) { return static_cast<int>(value); };
    light.settings = {static_cast<TerrainLightKind>(h.kind),
                      i(h.order),
                      i(h.bounces),
                      i(h.rays),
                      i(h.azimuths),
                      i(h.stride),
                      h.albedo,
                      h.seed};
    light.grid.groundWidth = i(h.groundWidth);
    light.grid.groundHeight = i(h.groundHeight);
    light.grid.stride = i(h.stride);
    light.grid.width = i(h.width);
    light.grid.height = i(h.height);
    light.key = h.key;
    return light;
}

LightHeader readHeader(std::istream& in, const std::string& name, std::uintmax_t fileSize) {
    LightHeader h;
    in.read(reinterpret_cast<char*>(&h), sizeof h);
    if (in.bad()) throw DiskError(name);
    if (!in || std::memcmp(h.magic, kMagic, sizeof kMagic) != 0)
        throw Error(name, "", "expected light baked for a terrain, found something else",
                    "make one with stereonav bake");
    if (h.version != kFileVersion)
        throw Error(name, "version", fmt::format("expected {}, found {}", kFileVersion, h.version),
                    kBakeAgain);
    if (!plausible(h)) throw Error(name, "header", "expected sizes of baked light, found damage", kBakeAgain);
    const std::uintmax_t expected = sizeof h + sizesOf(h).bytes() + sizeof(std::uint64_t);
    if (fileSize != expected)
        throw Error(name, "",
                    fmt::format("expected {} bytes, found {}: cut off or damaged", expected, fileSize),
                    kBakeAgain);
    return h;
}

void checkGround(const std::string& name, const TerrainLight& light, const Heightfield& ground) {
    if (light.key == terrainLightKey(ground, light.settings)) return;
    throw Error(name, "",
                fmt::format("the light was baked from other ground ({}x{} samples) than is shown ({}x{})",
                            light.grid.groundWidth, light.grid.groundHeight, ground.width(), ground.height()),
                "bake it for this scene, with the same --vertical-scale, --open-holes, --tiles and --memory");
}

}  // namespace

void saveTerrainLight(const std::filesystem::path& file, const TerrainLight& light) {
    const LightHeader header = headerOf(light);
    const std::uint64_t sum = checksum(header, light);
    writeFileAtomically(
        file,
        [&](const std::filesystem::path& temporary) {
            std::ofstream out(temporary, std::ios::binary);
            out.write(reinterpret_cast<const char*>(&header), sizeof header);
            write(out, light.openness);
            write(out, light.horizon);
            write(out, light.full);
            write(out, light.bounced);
            out.write(reinterpret_cast<const char*>(&sum), sizeof sum);
            out.close();
            if (!out) throw Error(file.string(), "", "could not be written", "is the disk full?");
        },
        Over::Anything);  // what was there was looked at: it is another bake
}

bool isTerrainLight(const std::filesystem::path& file) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) return false;  // a pipe would be waited for
    std::ifstream in(file, std::ios::binary);
    char magic[sizeof kMagic] = {};
    in.read(magic, sizeof magic);
    return in && std::memcmp(magic, kMagic, sizeof kMagic) == 0;
}

TerrainLight loadTerrainLight(const std::filesystem::path& file, const Heightfield* ground) {
    const std::string name = file.string();
    checkFileToRead(file);
    std::error_code code;
    const std::uintmax_t size = std::filesystem::file_size(file, code);
    std::ifstream in(file, std::ios::binary);
    if (!in && std::filesystem::exists(file, code)) throw DiskError(name);
    if (code || !in) throw Error(name, "", "can not be read", "make it with stereonav bake");
    const LightHeader header = readHeader(in, name, size);
    const Sizes sizes = sizesOf(header);
    TerrainLight light = emptyLight(header);
    read(in, sizes.samples, light.openness);
    read(in, sizes.horizon, light.horizon);
    read(in, sizes.transfer, light.full);
    read(in, sizes.transfer, light.bounced);
    std::uint64_t sum = 0;
    in.read(reinterpret_cast<char*>(&sum), sizeof sum);
    if (in.bad()) throw DiskError(name);
    if (!in || sum != checksum(header, light))
        throw Error(name, "", "the checksum does not fit the content: the file is damaged", kBakeAgain);
    if (ground != nullptr) checkGround(name, light, *ground);
    return light;
}

}  // namespace stereonav
