// Header, bricks, sums: each with its hash, in the machine's byte order (little-endian on all that are
// supported).
#include "engine/light/bake/bake_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/light/skies/light_probe.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// Raised whenever the file's form, or what the same inputs give, changes.
constexpr std::uint32_t kVersion = 2;
constexpr std::array<char, 8> kMagic{'S', 'N', 'L', 'I', 'G', 'H', 'T', '\n'};

struct Header {
    std::array<char, 8> magic = kMagic;
    std::uint32_t version = kVersion, kind = 0;
    std::uint64_t key = 0, content = 0, bytes = 0;
    std::int32_t size[3] = {};
    std::uint32_t order = 0, channels = 0, spare = 0;
    double spacing[3] = {}, origin[3] = {}, axes[9] = {};
    std::uint64_t bricks = 0, texels = 0;
    std::uint64_t bricksHash = 0, sumsHash = 0, aliveHash = 0;
    std::uint64_t headerHash = 0;  // hash of all before it
};
static_assert(sizeof(Header) == 232 && std::is_trivially_copyable_v<Header>);

struct BrickRecord {
    std::uint32_t number = 0, samples = 0;
    double variance = 0, square = 0;
    TexelMask wanted{};
};
static_assert(sizeof(BrickRecord) == 88 && std::is_trivially_copyable_v<BrickRecord>);
static_assert(sizeof(TexelSum) == 20 && sizeof(float) == 4);

std::uint64_t hashOf(const void* data, std::size_t bytes) {
    return Hash().add(data, bytes).value();
}
std::uint64_t headerHash(const Header& header) {
    return hashOf(&header, sizeof header - sizeof header.headerHash);
}

VolumeFrame frameOf(const Header& h) {
    VolumeFrame frame;
    for (int n = 0; n < 3; ++n) {
        frame.size[n] = h.size[n];
        frame.spacing[n] = h.spacing[n];
        frame.origin[n] = h.origin[n];
    }
    for (int n = 0; n < 9; ++n) frame.axes[n / 3][n % 3] = h.axes[n];
    return frame;
}

// The sums' memory as it goes into the file.
template <typename Sums>
auto sumBytes(Sums& sums) {
    using Byte = std::conditional_t<std::is_const_v<Sums>, const char, char>;
    if (sums.bricks().empty()) return std::span<Byte>();
    const bool transfer = sums.shape().kind == BakeKind::Transfer;
    auto* data = transfer ? reinterpret_cast<Byte*>(sums.transfer(0).data())
                          : reinterpret_cast<Byte*>(sums.light(0).data());
    const std::size_t each = transfer ? sums.shape().numbersPerTexel() * sizeof(float) : sizeof(TexelSum);
    return std::span<Byte>(data, sums.texels() * each);
}
template <typename Sums>
auto aliveBytes(Sums& sums) {
    using Byte = std::conditional_t<std::is_const_v<Sums>, const char, char>;
    if (sums.bricks().empty() || sums.shape().kind != BakeKind::Transfer) return std::span<Byte>();
    return std::span<Byte>(reinterpret_cast<Byte*>(sums.alive(0).data()), sums.texels());
}

std::vector<BrickRecord> recordsOf(const BakeSums& sums) {
    std::vector<BrickRecord> records(sums.bricks().size());
    for (std::size_t n = 0; n < records.size(); ++n) {
        const TexelBrick& brick = sums.bricks()[n];
        const BrickEstimate& estimate = sums.estimates[n];
        records[n] = {brick.number, sums.samples[n], estimate.variance, estimate.square, brick.wanted};
    }
    return records;
}

Header headerOf(const BakeIdentity& identity, const BakeSums& sums, std::span<const BrickRecord> records) {
    Header h;
    const VolumeFrame& frame = sums.frame();
    h.kind = static_cast<std::uint32_t>(sums.shape().kind);
    h.key = identity.key;
    h.content = identity.content;
    h.order = static_cast<std::uint32_t>(sums.shape().order);
    h.channels = static_cast<std::uint32_t>(sums.shape().channels);
    for (int n = 0; n < 3; ++n) {
        h.size[n] = frame.size[n];
        h.spacing[n] = frame.spacing[n];
        h.origin[n] = frame.origin[n];
    }
    for (int n = 0; n < 9; ++n) h.axes[n] = frame.axes[n / 3][n % 3];
    h.bricks = records.size();
    h.texels = sums.texels();
    const auto light = sumBytes(sums), alive = aliveBytes(sums);
    h.bytes = sizeof h + records.size_bytes() + light.size() + alive.size();
    h.bricksHash = hashOf(records.data(), records.size_bytes());
    h.sumsHash = hashOf(light.data(), light.size());
    h.aliveHash = hashOf(alive.data(), alive.size());
    h.headerHash = headerHash(h);
    return h;
}

struct Useless {
    std::string why;  // never leaves this file
};
struct DiskFails {};  // neither: what can not be read now may be whole, and is not baked over

void take(std::istream& in, void* to, std::size_t bytes) {
    if (bytes == 0 || in.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) return;
    if (in.bad()) throw DiskFails();
    throw Useless{"can not be read to its end"};
}

// Counts are small enough for all sums below to be exact.
void checkHeader(const Header& h, std::uint64_t fileBytes, std::optional<std::uint64_t> key) {
    if (h.magic != kMagic) throw Useless{"is no bake"};
    if (h.version != kVersion)
        throw Useless{fmt::format("is of format version {}, this program's is {}", h.version, kVersion)};
    if (h.headerHash != headerHash(h)) throw Useless{"is damaged in its header"};
    if (key && h.key != *key) throw Useless{"is the bake of something else"};
    if (h.bytes != fileBytes)
        throw Useless{fmt::format("is cut off or grown: {} bytes, expected {}", fileBytes, h.bytes)};
    const bool sizes = h.size[0] >= 1 && h.size[1] >= 1 && h.size[2] >= 1 && h.size[0] <= 1 << 20 &&
                       h.size[1] <= 1 << 20 && h.size[2] <= 1 << 20;
    const bool shape =
        h.kind <= 2 && h.order >= 1 && h.order <= kMaxHarmonicsOrder && (h.channels == 1 || h.channels == 3);
    if (!sizes || !shape || h.bricks > 1u << 23 || h.texels > h.bricks * 512)
        throw Useless{"has sizes that can not be"};
    const BakeShape s{static_cast<BakeKind>(h.kind), static_cast<int>(h.order), static_cast<int>(h.channels)};
    if (h.bytes != sizeof h + h.bricks * sizeof(BrickRecord) + h.texels * s.bytesPerTexel())
        throw Useless{"has sizes that do not fit together"};
}

std::vector<TexelBrick> checkedBricks(const Header& h, std::span<const BrickRecord> records) {
    const TexelLayout layout(frameOf(h).size);
    std::vector<TexelBrick> bricks;
    std::uint64_t texels = 0;
    for (const BrickRecord& r : records) {
        const bool inOrder = bricks.empty() || r.number > bricks.back().number;
        const int count = countTexels(r.wanted);
        if (!inOrder || r.number >= layout.count() / 512 || count == 0)
            throw Useless{"has bricks that can not be"};
        texels += static_cast<std::uint64_t>(count);
        bricks.push_back({r.number, r.wanted});
    }
    if (texels != h.texels) throw Useless{"has sizes that do not fit together"};
    return bricks;
}

BakeFile readFrom(std::istream& in, std::uint64_t fileBytes, std::optional<std::uint64_t> key) {
    Header h;
    if (fileBytes < sizeof h)
        throw Useless{fmt::format("is cut off: {} bytes, expected {} and more", fileBytes, sizeof h)};
    take(in, &h, sizeof h);
    checkHeader(h, fileBytes, key);
    std::vector<BrickRecord> records(h.bricks);
    take(in, records.data(), records.size() * sizeof(BrickRecord));
    if (hashOf(records.data(), records.size() * sizeof(BrickRecord)) != h.bricksHash)
        throw Useless{"is damaged in its bricks"};
    BakeFile file{
        {h.key, h.content},
        BakeSums(frameOf(h), checkedBricks(h, records),
                 {static_cast<BakeKind>(h.kind), static_cast<int>(h.order), static_cast<int>(h.channels)})};
    for (std::size_t n = 0; n < records.size(); ++n) {
        file.sums.samples[n] = records[n].samples;
        file.sums.estimates[n] = {records[n].variance, records[n].square};
    }
    const auto light = sumBytes(file.sums), alive = aliveBytes(file.sums);
    take(in, light.data(), light.size());
    take(in, alive.data(), alive.size());
    if (hashOf(light.data(), light.size()) != h.sumsHash) throw Useless{"is damaged in its sums"};
    if (hashOf(alive.data(), alive.size()) != h.aliveHash) throw Useless{"is damaged in its flags"};
    return file;
}

void addFrame(Hash& hash, const VolumeFrame& frame) {
    for (int n = 0; n < 3; ++n)
        hash.add(static_cast<std::int64_t>(frame.size[n])).add(frame.spacing[n]).add(frame.origin[n]);
    for (int n = 0; n < 9; ++n) hash.add(frame.axes[n / 3][n % 3]);
}

void addColor(Hash& hash, const glm::vec3& c) {
    hash.add(static_cast<double>(c.x)).add(static_cast<double>(c.y)).add(static_cast<double>(c.z));
}

void addLight(Hash& hash, const LightSetup& light) {
    addColor(hash, light.sky);
    hash.add(static_cast<std::int64_t>(light.probe != nullptr));
    if (light.probe) {
        const std::span<const glm::vec3> pixels = light.probe->pixels();
        hash.add(static_cast<std::int64_t>(light.probe->width()));
        hash.add(static_cast<std::int64_t>(light.probe->height()));
        hash.add(pixels.data(), pixels.size_bytes());
    }
    hash.add(static_cast<std::int64_t>(light.lights.size()));
    for (const PointLight& l : light.lights) {
        hash.add(l.position.x).add(l.position.y).add(l.position.z).add(l.radius);
        addColor(hash, l.intensity);
    }
}

}  // namespace

std::uint64_t bakeKey(const BakeInputs& in) {
    Hash hash;
    const auto whole = [&](auto value) { hash.add(static_cast<std::int64_t>(value)); };
    whole(kVersion);
    whole(in.content);
    whole(in.shape.kind);
    if (in.shape.kind == BakeKind::Irradiance) addLight(hash, in.light);
    if (in.shape.kind != BakeKind::Openness) {
        addColor(hash, in.light.albedo);
        whole(in.light.bounces);
    }
    // Only where there is one, so that keys of before stay: lights chosen by chance, a reach.
    if (in.shape.kind == BakeKind::Irradiance && choosesLights(in.light, in.sampling)) whole(1);
    if (in.light.reach > 0) hash.add(double{in.light.reach});
    if (in.shape.kind == BakeKind::Transfer) {
        whole(in.shape.order);
        whole(in.shape.channels);
    }
    const TexelSampling& s = in.sampling;
    for (const bool flag : {s.naive, s.lowDiscrepancy, s.cosine, s.nextEvent, s.roulette}) whole(flag);
    whole(s.seed);
    addFrame(hash, in.texels);
    whole(in.choice.full);
    whole(in.choice.region != nullptr);
    if (!in.choice.full) hash.add(double{in.choice.lowest}).add(double{in.choice.highest});
    // Only where they are others than those of the texels, so that keys of before stay.
    const bool all = in.choice.full && std::isinf(s.lowest) && std::isinf(s.highest);
    const bool same =
        !in.choice.full && s.lowest == double{in.choice.lowest} && s.highest == double{in.choice.highest};
    if (!all && !same) hash.add(s.lowest).add(s.highest);
    return hash.value();
}

std::uint64_t contentHash(const GreyVolume& volume) {
    Hash hash;
    addFrame(hash, volume.frame);
    hash.add(volume.values.data(), volume.values.size() * sizeof(std::int16_t));
    return hash.value();
}

std::uint64_t contentHashNear(const GreyVolume& volume, const MaskVolume& region,
                              std::span<const TexelBrick> bricks) {
    Hash hash;
    addFrame(hash, volume.frame);
    hash.add(region.values.data(), region.values.size());
    const TexelLayout layout(volume.frame.size);
    std::vector<std::int16_t> values;
    for (const TexelBrick& brick : bricks) {
        values.clear();
        for (const glm::ivec3& t : texelsIn(layout, brick))
            if (volume.frame.contains(t)) values.push_back(volume.at(t));
        hash.add(static_cast<std::int64_t>(brick.number));
        hash.add(values.data(), values.size() * sizeof(std::int16_t));
    }
    return hash.value();
}

fs::path bakeCacheFile(std::uint64_t key) {
    return keptFile(fmt::format("light-v{}-{:016x}.bake", kVersion, key));
}

std::optional<BakeFile> readBakeFile(const fs::path& file, std::optional<std::uint64_t> key,
                                     std::string& problem) {
    problem.clear();
    std::error_code code;
    const std::uintmax_t bytes = fs::file_size(file, code);
    if (code) {
        if (fs::exists(file, code)) problem = "is no file that can be read";
        return std::nullopt;
    }
    try {
        std::ifstream in(file, std::ios::binary);
        if (!in) throw DiskFails();
        return readFrom(in, bytes, key);
    } catch (const DiskFails&) {
        throw Error(file.string(), "", "can not be read to its end: the disk reports an error",
                    "copy it to another disk, or name another with --out");
    } catch (const Useless& useless) {
        problem = useless.why;
    } catch (const Error& error) {  // too large for this machine
        problem = std::string("can not be used: ") + error.what();
    }
    return std::nullopt;
}

bool isForeignFile(const fs::path& file) {
    std::error_code code;
    if (!fs::exists(file, code)) return false;
    if (!fs::is_regular_file(file, code)) return true;
    std::ifstream in(file, std::ios::binary);
    std::array<char, 8> magic{};
    if (!in.read(magic.data(), magic.size())) return fs::file_size(file, code) > 0;
    return magic != kMagic;
}

void writeBakeFile(const fs::path& file, const BakeIdentity& identity, const BakeSums& sums) {
    const std::vector<BrickRecord> records = recordsOf(sums);
    const Header header = headerOf(identity, sums, records);
    writeFileAtomically(
        file,
        [&](const fs::path& temporary) {
            std::ofstream out(temporary, std::ios::binary);
            const auto put = [&](const void* data, std::size_t bytes) {
                out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
            };
            put(&header, sizeof header);
            put(records.data(), records.size() * sizeof(BrickRecord));
            put(sumBytes(sums).data(), sumBytes(sums).size());
            put(aliveBytes(sums).data(), aliveBytes(sums).size());
            out.close();
            if (!out)
                throw Error(file.string(), "", "can not be written",
                            "check that the folder exists and has room and write permission");
        },
        Over::Anything);  // the bake goes on from what was there
}

}  // namespace stereonav
