// Samples of a volume file into memory: from one data file or several, packed or not, as bytes of either
// order or as text. Only what the header says is ever taken, however much a stream holds.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "colon/study/study_header.h"
#include "colon/study/study_stream.h"
#include "engine/base/file.h"
#include "engine/base/parallel.h"
#include "engine/base/regular_file.h"
#include "engine/text/number.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// deflate never makes more than 1032 bytes of one (zlib's technical notes).
constexpr std::uint64_t kMostInflation = 1032;
constexpr std::size_t kReadBlock = 8 << 20, kLineBlock = 1 << 18;
// Bytes before samples that are compressed with them: each has to be unpacked to be left out.
constexpr std::uint64_t kMostPackedSkip = 64 << 20;
constexpr std::size_t kLongestNumber = 400;  // characters

std::uint64_t bytesExpected(const VolumeHeader& header) {
    auto bytes = static_cast<std::uint64_t>(header.voxelBytes());
    for (const std::uint64_t n : header.size) bytes *= n;
    return bytes;
}

[[noreturn]] void refuseCut(const fs::path& file, std::uint64_t expected, std::uint64_t found,
                            const char* kind) {
    throw Error(
        file.string(), "",
        fmt::format("cut off: the header says {} bytes of samples, found {}{}", expected, found, kind),
        "copy the file again");
}

// Returns the byte of a data file at which its samples begin, behind what the header has readers skip.
std::uint64_t startOf(const fs::path& data, const SamplePlace& place, std::uint64_t share) {
    if (place.atEnd) {
        const std::uint64_t size = fs::file_size(data);
        return size - std::min(size, share);
    }
    if (place.lines == 0) return place.offset;
    RegularFile in(data);
    in.seek(place.offset);
    std::vector<char> block(kLineBlock);
    std::uint64_t at = place.offset, lines = 0;
    while (const std::size_t held = in.read(block.data(), block.size())) {
        for (std::size_t n = 0; n < held; ++n)
            if (block[n] == '\n' && ++lines == place.lines) return at + n + 1;
        at += held;
    }
    return at;
}

// Counts what was read of all files, for messages and progress.
struct Reading {
    const fs::path& file;
    const VolumeHeader& header;
    Progress& progress;
    const std::function<void(std::uint64_t)>& come;
    std::uint64_t expected = 0, done = 0;

    void add(std::uint64_t bytes) {
        done += bytes;
        come(done);
        const double share =
            static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(expected, 1));
        progress.report(share, "reading " + file.filename().string());
    }
};

void leaveOut(ByteStream& stream, std::uint64_t bytes) {
    std::vector<unsigned char> spare(std::min<std::uint64_t>(bytes, kReadBlock));
    while (bytes > 0) {
        const std::size_t block = std::min<std::uint64_t>(bytes, spare.size());
        if (stream.read(spare.data(), block) < block) return;
        bytes -= block;
    }
}

void readBytes(ByteStream& stream, unsigned char* to, std::uint64_t count, Reading& reading) {
    for (std::uint64_t at = 0; at < count;) {
        const std::size_t block = std::min<std::uint64_t>(count - at, kReadBlock);
        const std::size_t found = stream.read(to + at, block);
        reading.add(found);
        at += found;
        if (found < block) refuseCut(reading.file, reading.expected, reading.done, "");
    }
    stream.finish();
}

// Characters of a stream, one at a time; -1 at the end.
class Characters {
public:
    explicit Characters(ByteStream& stream) : mStream(stream), mBlock(1 << 18) {}
    int next() {
        if (mAt == mHeld) {
            mHeld = mStream.read(mBlock.data(), mBlock.size());
            mAt = 0;
            if (mHeld == 0) return -1;
        }
        return mBlock[mAt++];
    }

private:
    ByteStream& mStream;
    std::vector<unsigned char> mBlock;
    std::size_t mAt = 0, mHeld = 0;
};

bool parts(int c) {
    return c == ' ' || (c >= '\t' && c <= '\r') || c == ',';
}

template <typename T>
bool numberInto(const std::string& word, T& number) {
    if constexpr (std::is_floating_point_v<T>) {
        std::string_view rest = word;
        number = static_cast<T>(takeNumber(rest, Plus::Allowed).value_or(0));
        return rest.empty();
    } else {
        const std::optional<T> whole = wholeOf<T>(word, Plus::Allowed);
        number = whole.value_or(0);
        return whole.has_value();
    }
}

template <typename T>
void readNumbers(ByteStream& stream, T* to, std::uint64_t count, Reading& reading) {
    constexpr std::uint64_t kReportEach = 1 << 16;
    Characters characters(stream);
    std::string word;
    std::uint64_t found = 0;
    for (int c = ' '; found < count && c >= 0;) {
        c = characters.next();
        if (c >= 0 && !parts(c)) {
            if (word.size() < kLongestNumber) word += static_cast<char>(c);
            continue;
        }
        if (word.empty()) continue;
        if (!numberInto(word, to[found]))
            throw Error(
                reading.file.string(),
                fmt::format("sample {}", reading.done / sizeof(T) + found % kReportEach + 1),
                fmt::format("expected a number of the header's type, found \"{}\"", word.substr(0, 40)),
                "save the file again");
        word.clear();
        if (++found % kReportEach == 0) reading.add(kReportEach * sizeof(T));
    }
    reading.add(found % kReportEach * sizeof(T));
    if (found < count)
        throw Error(reading.file.string(), "",
                    fmt::format("cut off: the header says {} samples, found {}", reading.expected / sizeof(T),
                                reading.done / sizeof(T)),
                    "copy the file again");
}

int hexDigit(int c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

void readHex(ByteStream& stream, unsigned char* to, std::uint64_t count, Reading& reading) {
    constexpr std::uint64_t kReportEach = 1 << 16;
    Characters characters(stream);
    for (std::uint64_t n = 0; n < 2 * count;) {
        const int c = characters.next();
        if (c < 0) refuseCut(reading.file, reading.expected, reading.done + n / 2 % kReportEach, "");
        if (parts(c)) continue;
        const int digit = hexDigit(c);
        if (digit < 0)
            throw Error(reading.file.string(), "",
                        fmt::format("expected hexadecimal digits for samples, found character {}", c),
                        "save the file again");
        to[n / 2] = static_cast<unsigned char>(n % 2 ? to[n / 2] << 4 | digit : digit);
        if (++n % (2 * kReportEach) == 0) reading.add(kReportEach);
    }
    reading.add(count % kReportEach);
}

void readText(ByteStream& stream, SampleType type, unsigned char* to, std::uint64_t count, Reading& reading) {
    const auto as = [&](auto zero) {
        readNumbers(stream, reinterpret_cast<decltype(zero)*>(to), count, reading);
    };
    switch (type) {
        case SampleType::UInt8:
            return as(std::uint8_t{});
        case SampleType::Int8:
            return as(std::int8_t{});
        case SampleType::UInt16:
            return as(std::uint16_t{});
        case SampleType::Int16:
            return as(std::int16_t{});
        case SampleType::UInt32:
            return as(std::uint32_t{});
        case SampleType::Int32:
            return as(std::int32_t{});
        case SampleType::UInt64:
            return as(std::uint64_t{});
        case SampleType::Int64:
            return as(std::int64_t{});
        case SampleType::Float32:
            return as(float{});
        default:
            return as(double{});
    }
}

void turnBytes(unsigned char* samples, std::uint64_t bytes, int each) {
    constexpr std::uint64_t kBlock = 1 << 20;
    if (each == 1) return;
    parallelFor(static_cast<int>((bytes + kBlock - 1) / kBlock), [&](int n) {
        unsigned char* const end = samples + std::min(bytes, kBlock * (static_cast<std::uint64_t>(n) + 1));
        for (unsigned char* at = samples + kBlock * n; at < end; at += each) std::reverse(at, at + each);
    });
}

}  // namespace

void checkSampleFiles(const fs::path& file, const VolumeHeader& header) {
    const SamplePlace& place = header.place;
    if (place.files.empty())
        throw Error(file.string(), "", "names no data file", "the header is damaged: get it again");
    std::uint64_t found = 0;
    for (const fs::path& data : place.files) {
        checkFileToRead(data);
        std::error_code code;
        const auto bytes = fs::file_size(data, code);
        if (code)
            throw Error(file.string(), "", "its data file " + data.string() + " can not be opened",
                        "put it beside the header under that name");
        const bool raw = place.encoding == SampleEncoding::Raw;
        const std::uint64_t before = place.offset + (raw && !place.atEnd ? place.skip : 0);
        found += bytes - std::min<std::uint64_t>(bytes, before);
    }
    const bool packed = place.encoding == SampleEncoding::Deflate || place.encoding == SampleEncoding::Bzip2;
    if (packed && place.skip > kMostPackedSkip)
        throw Error(file.string(), "",
                    fmt::format("expected compressed samples behind at most {} bytes, found {} to leave out",
                                kMostPackedSkip, place.skip),
                    "correct it in the header, or save it without compression");
    const std::uint64_t expected = bytesExpected(header), count = expected / bytesOf(header.type);
    if (place.files.size() > 1 && count % place.files.size() != 0)
        throw Error(file.string(), "",
                    fmt::format("expected data files of equal shares, found {} files for {} samples",
                                place.files.size(), count),
                    "correct it in the header");
    switch (place.encoding) {
        case SampleEncoding::Raw:
            if (found < expected) refuseCut(file, expected, found, "");
            break;
        case SampleEncoding::Deflate:
            if (found < expected / kMostInflation) refuseCut(file, expected, found, " compressed ones");
            break;
        case SampleEncoding::Bzip2:
            break;  // has no such bound; samples are counted as they come
        case SampleEncoding::Text:
            if (found + 1 < 2 * count) refuseCut(file, expected, found, " characters");
            break;
        case SampleEncoding::Hex:
            if (found < 2 * expected) refuseCut(file, expected, found / 2, "");
            break;
    }
}

void readSamples(const fs::path& file, const VolumeHeader& header, unsigned char* to, Progress& progress,
                 const std::function<void(std::uint64_t bytes)>& come) {
    const SamplePlace& place = header.place;
    progress.report(0, "reading " + file.filename().string());
    Reading reading{file, header, progress, come, bytesExpected(header)};
    const std::uint64_t share = reading.expected / place.files.size();
    for (const fs::path& data : place.files) {
        const auto stream = openStream(data, startOf(data, place, share), place.encoding);
        leaveOut(*stream, place.atEnd ? 0 : place.skip);
        if (place.encoding == SampleEncoding::Text)
            readText(*stream, header.type, to, share / bytesOf(header.type), reading);
        else if (place.encoding == SampleEncoding::Hex)
            readHex(*stream, to, share, reading);
        else
            readBytes(*stream, to, share, reading);
        to += share;
    }
    if (place.turned && place.encoding != SampleEncoding::Text)
        turnBytes(to - reading.expected, reading.expected, bytesOf(header.type));
}

}  // namespace stereonav
