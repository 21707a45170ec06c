// One file a key: a header with the size and the hash of what follows; then the frame, texts, the centreline,
// the lumen in runs, and the field in bricks of 8^3 voxels that hold lumen or touch one that does.
#include "colon/scene/colon_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <span>

#include "colon/scene/saved_lumen.h"
#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/memory.h"
#include "engine/base/pages.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// Raised whenever the file's form, or what is found in the same study, changes.
constexpr std::uint32_t kVersion = 7;
constexpr int kBrick = 8;

struct Header {
    char magic[8] = {'S', 'N', 'C', 'O', 'L', 'O', 'N', '\n'};
    std::uint64_t version = kVersion;
    std::uint64_t key = 0, bytes = 0, hash = 0;
};
static_assert(sizeof(Header) == 40);

struct Damaged {};  // never leaves this file

class Writer {
public:
    void bytes(const void* data, std::size_t count) {
        const char* from = static_cast<const char*>(data);
        mBytes.insert(mBytes.end(), from, from + count);
    }
    template <typename T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(&value, sizeof value);
    }
    void text(const std::string& s) {
        put(static_cast<std::uint64_t>(s.size()));
        bytes(s.data(), s.size());
    }
    void texts(const std::vector<std::string>& list) {
        put(static_cast<std::uint64_t>(list.size()));
        for (const std::string& s : list) text(s);
    }
    template <typename T>
    void list(const std::vector<T>& values) {
        put(static_cast<std::uint64_t>(values.size()));
        for (const T& value : values) put(value);
    }
    const std::vector<char>& result() const { return mBytes; }

private:
    std::vector<char> mBytes;
};

class Reader {
public:
    explicit Reader(std::span<const char> data) : mData(data) {}
    const char* take(std::size_t count) {
        if (count > mData.size() - mAt) throw Damaged();
        const char* at = mData.data() + mAt;
        mAt += count;
        return at;
    }
    template <typename T>
    T get() {
        T value;
        std::memcpy(&value, take(sizeof value), sizeof value);
        return value;
    }
    std::size_t count(std::size_t each) {
        const auto n = get<std::uint64_t>();
        if (n > (mData.size() - mAt) / each) throw Damaged();
        return n;
    }
    std::string text() {
        const std::size_t n = count(1);
        return std::string(take(n), n);
    }
    std::vector<std::string> texts() {
        std::vector<std::string> list(count(8));
        for (std::string& s : list) s = text();
        return list;
    }
    template <typename T>
    std::vector<T> list() {
        std::vector<T> values(count(sizeof(T)));
        for (T& value : values) value = get<T>();
        return values;
    }
    bool atEnd() const { return mAt == mData.size(); }

private:
    std::span<const char> mData;
    std::size_t mAt = 0;
};

struct Bricks {
    glm::ivec3 counts;
    std::vector<std::uint8_t> kept;
    explicit Bricks(const glm::ivec3& size)
        : counts((size + kBrick - 1) / kBrick),
          kept(static_cast<std::size_t>(counts.x) * counts.y * counts.z) {}
    std::size_t index(const glm::ivec3& b) const {
        return (static_cast<std::size_t>(b.z) * counts.y + b.y) * counts.x + b.x;
    }
    std::uint8_t& at(const glm::ivec3& b) { return kept[index(b)]; }
    std::uint8_t at(const glm::ivec3& b) const { return kept[index(b)]; }
};

// Calls use(first value of a row, values) for the rows of the kept bricks.
template <typename Use>
void forKeptRows(const Bricks& bricks, const VolumeFrame& frame, const Use& use) {
    std::size_t n = 0;
    for (int z = 0; z < bricks.counts.z; ++z)
        for (int y = 0; y < bricks.counts.y; ++y)
            for (int x = 0; x < bricks.counts.x; ++x) {
                if (!bricks.kept[n++]) continue;
                const glm::ivec3 first = glm::ivec3(x, y, z) * kBrick,
                                 last = glm::min(first + kBrick, frame.size);
                for (int k = first.z; k < last.z; ++k)
                    for (int j = first.y; j < last.y; ++j)
                        use(frame.index(first.x, j, k), static_cast<std::size_t>(last.x - first.x));
            }
}

Bricks bricksNear(const MaskVolume& lumen) {
    Bricks holding(lumen.frame.size), bricks(lumen.frame.size);
    parallelFor(holding.counts.z, [&](int layer) {
        const int first = layer * kBrick, end = std::min(first + kBrick, lumen.frame.size.z);
        for (int k = first; k < end; ++k)
            for (int j = 0; j < lumen.frame.size.y; ++j) {
                const std::uint8_t* row = &lumen.values[lumen.frame.index(0, j, k)];
                for (int i = 0; i < lumen.frame.size.x; ++i)
                    if (row[i]) holding.at({i / kBrick, j / kBrick, layer}) = 1;
            }
        releaseZeroPages(lumen.values, lumen.frame.index(0, 0, first),
                         lumen.frame.index(0, 0, end) - lumen.frame.index(0, 0, first));
    });
    glm::ivec3 b;
    for (b.z = 0; b.z < bricks.counts.z; ++b.z)
        for (b.y = 0; b.y < bricks.counts.y; ++b.y)
            for (b.x = 0; b.x < bricks.counts.x; ++b.x) {
                if (!holding.at(b)) continue;
                const glm::ivec3 low = glm::max(b - 1, 0), high = glm::min(b + 1, bricks.counts - 1);
                for (int z = low.z; z <= high.z; ++z)
                    for (int y = low.y; y <= high.y; ++y)
                        for (int x = low.x; x <= high.x; ++x) bricks.at({x, y, z}) = 1;
            }
    return bricks;
}

struct Run {
    std::uint32_t value = 0, count = 0;
};
std::vector<Run> runsOfMask(const MaskVolume& mask) {
    std::vector<Run> runs;
    const std::size_t count = mask.frame.count();
    for (std::size_t n = 0; n < count;) {
        const std::uint8_t value = mask.values[n];
        std::size_t end = n + 1;
        while (end < count && mask.values[end] == value && end - n < 0xFFFFFFFFu) ++end;
        runs.push_back({value, static_cast<std::uint32_t>(end - n)});
        n = end;
    }
    return runs;
}
MaskVolume maskOf(const std::vector<Run>& runs, const VolumeFrame& frame) {
    MaskVolume mask(frame);
    std::size_t n = 0;
    for (const Run& run : runs) {
        if (run.count > frame.count() - n || run.value > 255) throw Damaged();
        if (run.value) std::fill_n(&mask.values[n], run.count, static_cast<std::uint8_t>(run.value));
        n += run.count;
    }
    if (n != frame.count()) throw Damaged();
    return mask;
}

std::vector<char> packed(const FoundColon& found) {
    Writer out;
    const LumenField& lumen = found.lumen;
    out.put(lumen.field.frame);
    out.put(lumen.field.scale);
    out.put(lumen.field.offset);
    out.put(lumen.isovalue);
    out.text(found.format);
    out.put(static_cast<std::uint8_t>(found.ofMask));
    out.put(found.studyFrame);
    out.put(found.values);
    out.texts(found.notes);
    out.texts(lumen.notes);
    out.list(lumen.segments);
    out.list(found.centreline.points);
    out.list(found.polyps);
    out.list(runsOfMask(lumen.lumen));
    const Bricks bricks = bricksNear(lumen.lumen);
    out.list(bricks.kept);
    forKeptRows(bricks, lumen.field.frame, [&](std::size_t first, std::size_t count) {
        out.bytes(&lumen.field.values[first], count * sizeof(std::int16_t));
    });
    return out.result();
}

void checkFrame(const VolumeFrame& frame) {
    const glm::ivec3 s = frame.size;
    if (s.x < 1 || s.y < 1 || s.z < 1 || s.x > 8192 || s.y > 8192 || s.z > 8192) throw Damaged();
}

FoundColon unpacked(std::span<const char> bytes) {
    Reader in(bytes);
    FoundColon found;
    LumenField& lumen = found.lumen;
    const auto frame = in.get<VolumeFrame>();
    checkFrame(frame);
    // The field and the lumen, then distances and their squares.
    constexpr double kBytes = 2 + 1 + 2 + 4;
    checkMemory(fmt::format("a colon of {} x {} x {} voxels", frame.size.x, frame.size.y, frame.size.z),
                kBytes * static_cast<double>(frame.count()), "make the study coarser");
    lumen.field = GreyVolume(frame);
    lumen.field.scale = in.get<double>();
    lumen.field.offset = in.get<double>();
    lumen.isovalue = in.get<double>();
    found.format = in.text();
    found.ofMask = in.get<std::uint8_t>() != 0;
    found.studyFrame = in.get<VolumeFrame>();
    found.values = in.get<ValueSpan>();
    found.notes = in.texts();
    lumen.notes = in.texts();
    lumen.segments = in.list<LumenSegment>();
    found.centreline.points = in.list<CentrelinePoint>();
    found.polyps = in.list<Polyp>();
    lumen.lumen = maskOf(in.list<Run>(), frame);
    Bricks bricks(frame.size);
    const auto kept = in.list<std::uint8_t>();
    if (kept.size() != bricks.kept.size()) throw Damaged();
    bricks.kept = kept;
    forKeptRows(bricks, frame, [&](std::size_t first, std::size_t count) {
        std::memcpy(&lumen.field.values[first], in.take(count * sizeof(std::int16_t)),
                    count * sizeof(std::int16_t));
    });
    if (!in.atEnd()) throw Damaged();
    return found;
}

}  // namespace

fs::path colonCacheFile(std::uint64_t key) {
    return keptFile(fmt::format("colon-v{}-{:016x}.bin", kVersion, key));
}

std::uint64_t builtInColonKey(const BuiltInColonSetting& setting) {
    Hash hash;
    hash.add("the built-in colon 2").add(static_cast<std::int64_t>(setting.seed));
    for (int axis = 0; axis < 3; ++axis) hash.add(static_cast<std::int64_t>(setting.size[axis]));
    if (setting.bend != 0 || setting.inflation != 1) hash.add(setting.bend).add(setting.inflation);
    return hash.value();
}

std::uint64_t colonCacheKey(std::uint64_t study, const ColonOptions& options) {
    Hash hash;
    hash.add(static_cast<std::int64_t>(kVersion)).add(static_cast<std::int64_t>(study));
    const SegmentationSetting& s = options.segmentation;
    hash.add(s.air).add(s.tagged).add(s.wall).add(static_cast<std::int64_t>(s.seeds.size()));
    for (const glm::dvec3& seed : s.seeds) hash.add(seed.x).add(seed.y).add(seed.z);
    addChoices(s.choices, hash);
    if (s.leavesFluid) hash.add("fluid is left");
    if (s.maskSmoothing != 0.0) hash.add("mask smoothed").add(s.maskSmoothing.value_or(-1));
    const CentrelineSetting& line = options.centreline;
    hash.add(line.spacing).add(static_cast<std::int64_t>(line.reversed));
    // Only where it is another one than usual, so that keys of before stay.
    if (line.mostUneven != CentrelineSetting().mostUneven)
        hash.add(static_cast<std::int64_t>(line.mostUneven));
    return hash.value();
}

std::optional<FoundColon> readColonCache(std::uint64_t key, bool& damaged) {
    damaged = false;
    const fs::path file = colonCacheFile(key);
    std::error_code code;
    const std::uintmax_t size = fs::file_size(file, code);
    if (code) return std::nullopt;
    damaged = true;
    std::ifstream in(file, std::ios::binary);
    Header header;
    const Header expected;
    if (size < sizeof header || !in.read(reinterpret_cast<char*>(&header), sizeof header))
        return std::nullopt;
    if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0 || header.version != kVersion ||
        header.key != key || header.bytes != size - sizeof header)
        return std::nullopt;
    std::vector<char> bytes(header.bytes);
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) return std::nullopt;
    if (Hash().add(bytes.data(), bytes.size()).value() != header.hash) return std::nullopt;
    try {
        FoundColon found = unpacked(bytes);
        damaged = false;
        noteUse(file);
        return found;
    } catch (const Damaged&) {
        return std::nullopt;
    }
}

void dropFarValues(LumenField& lumen) {
    const Bricks bricks = bricksNear(lumen.lumen);
    const VolumeFrame& frame = lumen.field.frame;
    parallelFor(bricks.counts.z, [&](int z) {
        const int first = z * kBrick, end = std::min(first + kBrick, frame.size.z);
        for (int k = first; k < end; ++k)
            for (int j = 0; j < frame.size.y; ++j)
                for (int x = 0; x < bricks.counts.x; ++x) {
                    if (bricks.at({x, j / kBrick, z})) continue;
                    const int i = x * kBrick;
                    std::fill_n(&lumen.field.at(i, j, k), std::min(kBrick, frame.size.x - i),
                                std::int16_t{0});
                }
        releaseZeroPages(lumen.field.values, frame.index(0, 0, first),
                         frame.index(0, 0, end) - frame.index(0, 0, first));
    });
}

bool writeColonCache(std::uint64_t key, const FoundColon& found) {
    const std::vector<char> bytes = packed(found);
    Header header;
    header.key = key;
    header.bytes = bytes.size();
    header.hash = Hash().add(bytes.data(), bytes.size()).value();
    const auto write = [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out.write(reinterpret_cast<const char*>(&header), sizeof header);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out)
            throw Error(colonCacheFile(key).string(), "", "can not be written", "check the room on the disk");
    };
    return keep(colonCacheFile(key), [&](const fs::path& file) { writeFileAtomically(file, write); });
}

}  // namespace stereonav
