#include "engine/image/stereo_picture_file.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "engine/base/error.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr int kApp0 = 0xE0, kApp1 = 0xE1, kApp2 = 0xE2, kApp3 = 0xE3;

bool hasExtension(const std::filesystem::path& file, std::string_view small) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension == small;
}

// Most significant byte first, as all of these segments have it. Byte by byte: g++ 12 takes a copy into a
// vector whose size it sees for one beyond its end.
void put(Bytes& to, std::uint32_t value, int bytes) {
    for (int n = bytes - 1; n >= 0; --n) to.push_back(static_cast<unsigned char>(value >> (8 * n)));
}
void put(Bytes& to, std::string_view text) {
    for (const char c : text) to.push_back(static_cast<unsigned char>(c));
}
void put(Bytes& to, std::span<const unsigned char> bytes) {
    to.reserve(to.size() + bytes.size());
    for (const unsigned char byte : bytes) to.push_back(byte);
}

void putSegment(Bytes& to, int marker, const Bytes& content) {
    put(to, 0xFF00u | static_cast<std::uint32_t>(marker), 2);
    put(to, static_cast<std::uint32_t>(content.size() + 2), 2);  // the length counts itself
    put(to, content);
}

// A JPEG's bytes apart: its start, JFIF's own segment (if any), and all behind.
struct JpegParts {
    std::span<const unsigned char> jfif, rest;
};

JpegParts partsOf(std::span<const unsigned char> jpeg) {
    if (jpeg.size() < 4 || jpeg[0] != 0xFF || jpeg[1] != 0xD8)
        throw Error("", "picture", "expected a JPEG file", "");
    JpegParts parts{{}, jpeg.subspan(2)};
    if (jpeg.size() < 6 || jpeg[2] != 0xFF || jpeg[3] != kApp0) return parts;
    const std::size_t bytes = 2 + (std::size_t{jpeg[4]} << 8 | jpeg[5]);
    if (bytes > parts.rest.size()) throw Error("", "picture", "a JPEG file is cut off", "");
    parts.jfif = parts.rest.first(bytes);
    parts.rest = parts.rest.subspan(bytes);
    return parts;
}

enum FieldType : std::uint32_t { kShort = 3, kLong = 4, kRational = 5, kUndefined = 7, kSignedRational = 10 };

struct Field {
    std::uint32_t tag, type, count;
    Bytes value;
};

Field field(std::uint32_t tag, FieldType type, std::uint32_t value) {
    Bytes bytes;
    put(bytes, value, type == kShort ? 2 : 4);
    return {tag, type, 1, bytes};
}
Field field(std::uint32_t tag, std::string_view undefined) {
    return {tag, kUndefined, static_cast<std::uint32_t>(undefined.size()),
            Bytes(undefined.begin(), undefined.end())};
}

// A fraction as fine as 32 bits can tell; all ones over all ones: unknown (DC-007, 5.2.4).
Field rational(std::uint32_t tag, FieldType type, double value) {
    Bytes bytes;
    std::uint32_t above = 0xFFFFFFFFu, below = 0xFFFFFFFFu;
    const double most = type == kRational ? 4e9 : 2e9, least = type == kRational ? 0 : -most;
    if (value >= least && value <= most) {  // not NaN
        below = 1'000'000'000;
        while (below > 1 && std::abs(value) * below > most) below /= 10;
        above = static_cast<std::uint32_t>(std::llround(value * below));
    }
    put(bytes, above, 4);
    put(bytes, below, 4);
    return {tag, type, 1, bytes};
}

// Appends a directory of TIFF (6.0, section 2) that begins `at` bytes behind its byte order; longer values
// follow it. next: where the next directory begins; 0: none.
void putDirectory(Bytes& to, const std::vector<Field>& fields, std::uint32_t at, std::uint32_t next) {
    std::uint32_t values = at + 2 + 12 * static_cast<std::uint32_t>(fields.size()) + 4;
    put(to, static_cast<std::uint32_t>(fields.size()), 2);
    Bytes behind;
    for (const Field& one : fields) {
        put(to, one.tag, 2);
        put(to, one.type, 2);
        put(to, one.count, 4);
        if (one.value.size() > 4) {
            put(to, values + static_cast<std::uint32_t>(behind.size()), 4);
            put(behind, one.value);
            continue;
        }
        Bytes inside = one.value;
        inside.resize(4);  // from the left
        put(to, inside);
    }
    put(to, next, 4);
    put(to, behind);
}
std::uint32_t directoryBytes(const std::vector<Field>& fields) {
    Bytes bytes;
    putDirectory(bytes, fields, 0, 0);
    return static_cast<std::uint32_t>(bytes.size());
}

constexpr std::string_view kTiffStart{"MM\0*\0\0\0\x08", 8};
constexpr std::uint32_t kFirstDirectory = 8;

// Returns the segment that the Multi-Picture Format asks of each of its pictures (Exif 2.3, 4.6).
Bytes exifSegment(int width, int height) {
    const std::vector<Field> own{field(0x9000, "0230"),
                                 field(0x9101, std::string_view("\1\2\3\0", 4)),  // Y, Cb, Cr
                                 field(0xA000, "0100"),
                                 field(0xA001, kShort, 1),  // sRGB
                                 field(0xA002, kLong, static_cast<std::uint32_t>(width)),
                                 field(0xA003, kLong, static_cast<std::uint32_t>(height))};
    std::vector<Field> first{rational(0x011A, kRational, 72), rational(0x011B, kRational, 72),
                             field(0x0128, kShort, 2),  // inches
                             field(0x0213, kShort, 1),  // pairs of colour in the middle of their pixels
                             field(0x8769, kLong, 0)};
    const std::uint32_t second = kFirstDirectory + directoryBytes(first);
    first.back() = field(0x8769, kLong, second);
    Bytes segment;
    put(segment, std::string_view("Exif\0\0", 6));
    put(segment, kTiffStart);
    putDirectory(segment, first, kFirstDirectory, 0);
    putDirectory(segment, own, second, 0);
    return segment;
}

constexpr std::string_view kMpfName{"MPF\0", 4};
constexpr std::string_view kMpfVersion = "0100";
constexpr std::uint32_t kDisparity = 0x020002, kRepresentative = 0x20000000;  // bits of an entry's attribute

// Fields of the eye `number`, counted from the left, 1 or 2; the left one is what the other is measured
// against.
std::vector<Field> eyeFields(std::uint32_t number, const EyePlacement& placement) {
    std::vector<Field> fields;
    if (number > 1) fields.push_back(field(0xB000, kMpfVersion));  // the first has it in the index
    const bool base = number == 1;
    fields.push_back(field(0xB101, kLong, number));
    fields.push_back(field(0xB204, kLong, 1));
    fields.push_back(rational(0xB205, kSignedRational, base ? 0 : placement.convergence_degrees));
    fields.push_back(rational(0xB206, kRational, base ? 0 : placement.separation_m));
    return fields;
}

struct MpoSizes {
    std::uint32_t first = 0, second = 0;  // bytes of the pictures
    std::uint32_t secondAt = 0;           // behind the first one's byte order
};

Bytes indexSegment(const MpoSizes& sizes, const EyePlacement& placement) {
    Bytes entries;
    for (const bool first : {true, false}) {
        put(entries, kDisparity | (first ? kRepresentative : 0u), 4);
        put(entries, first ? sizes.first : sizes.second, 4);
        put(entries, first ? 0u : sizes.secondAt, 4);
        put(entries, 0, 4);  // depends on no other
    }
    const std::vector<Field> index{field(0xB000, kMpfVersion), field(0xB001, kLong, 2),
                                   Field{0xB002, kUndefined, 32, entries}};
    const std::uint32_t own = kFirstDirectory + directoryBytes(index);
    Bytes segment;
    put(segment, kMpfName);
    put(segment, kTiffStart);
    putDirectory(segment, index, kFirstDirectory, own);
    putDirectory(segment, eyeFields(1, placement), own, 0);
    return segment;
}

Bytes secondSegment(const EyePlacement& placement) {
    Bytes segment;
    put(segment, kMpfName);
    put(segment, kTiffStart);
    putDirectory(segment, eyeFields(2, placement), kFirstDirectory, 0);
    return segment;
}

// JFIF's segment goes: Exif's has to be the first one.
Bytes withSegments(std::span<const unsigned char> jpeg, const Bytes& exif, const Bytes& mpf) {
    Bytes bytes{0xFF, 0xD8};
    putSegment(bytes, kApp1, exif);
    putSegment(bytes, kApp2, mpf);
    put(bytes, partsOf(jpeg).rest);
    return bytes;
}

}  // namespace

bool isJps(const std::filesystem::path& file) {
    return hasExtension(file, ".jps");
}

bool isMpo(const std::filesystem::path& file) {
    return hasExtension(file, ".mpo");
}

std::vector<unsigned char> jpsFromJpeg(std::span<const unsigned char> pair) {
    constexpr std::uint32_t kStereo = 1, kSideBySide = 2;
    constexpr std::uint32_t kFlags = 0, kSeparation = 0;  // whole height and width, the right eye first
    const JpegParts parts = partsOf(pair);
    Bytes segment;
    put(segment, "_JPSJPS_");
    put(segment, 4, 2);  // bytes of the descriptor
    put(segment, kSeparation << 24 | kFlags << 16 | kSideBySide << 8 | kStereo, 4);
    put(segment, 0, 2);  // bytes of a comment
    Bytes bytes{0xFF, 0xD8};
    put(bytes, parts.jfif);
    putSegment(bytes, kApp3, segment);
    put(bytes, parts.rest);
    return bytes;
}

std::vector<unsigned char> mpoFromJpegs(std::span<const unsigned char> left,
                                        std::span<const unsigned char> right, int width, int height,
                                        const EyePlacement& placement) {
    const Bytes exif = exifSegment(width, height);
    const Bytes second = withSegments(right, exif, secondSegment(placement));
    MpoSizes sizes;
    const std::size_t first = withSegments(left, exif, indexSegment(sizes, placement)).size();
    // Offsets count from the byte order of the index: behind the start, Exif's segment, a marker, a length
    // and the name.
    const std::size_t order = 2 + (4 + exif.size()) + 4 + kMpfName.size();
    if (first + second.size() > std::numeric_limits<std::uint32_t>::max())
        throw Error("", "picture", "two eyes of over 4 GB do not go into one .mpo", "make them smaller");
    sizes = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second.size()),
             static_cast<std::uint32_t>(first - order)};
    Bytes bytes = withSegments(left, exif, indexSegment(sizes, placement));
    put(bytes, second);
    return bytes;
}

std::vector<unsigned char> jpsBytes(const Plane<PackedColor>& pair) {
    return jpsFromJpeg(encodeColorImage(pair, ".jpg"));
}

std::vector<unsigned char> mpoBytes(const Plane<PackedColor>& left, const Plane<PackedColor>& right,
                                    const EyePlacement& placement) {
    if (left.width() != right.width() || left.height() != right.height())
        throw Error("", "picture", "expected two eyes of one size", "");
    return mpoFromJpegs(encodeColorImage(left, ".jpg"), encodeColorImage(right, ".jpg"), left.width(),
                        left.height(), placement);
}

}  // namespace stereonav
