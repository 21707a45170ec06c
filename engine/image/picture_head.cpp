// Sizes of pictures out of their files' heads, each format by its own definition: PNG 1.2, 11.2.2; JPEG (ITU
// T.81), B.2.2; TIFF 6.0, section 2, and BigTIFF; Windows bitmaps (BITMAPCOREHEADER, BITMAPINFOHEADER); WebP
// (RFC 9649).
#include <algorithm>
#include <cstdlib>

#include "engine/image/picture_format.h"

namespace stereonav {
namespace {

// A file's bytes; numbers beyond its end are 0, which is no size.
struct HeadBytes {
    std::string_view bytes;
    bool leastFirst = true;

    std::uint64_t number(std::uint64_t at, int count) const {
        if (at > bytes.size() || bytes.size() - at < static_cast<std::size_t>(count)) return 0;
        std::uint64_t value = 0;
        for (int n = 0; n < count; ++n) {
            const auto byte = static_cast<unsigned char>(bytes[at + static_cast<std::uint64_t>(n)]);
            value |= static_cast<std::uint64_t>(byte) << (8 * (leastFirst ? n : count - 1 - n));
        }
        return value;
    }
    long long size(std::uint64_t at, int count) const { return static_cast<long long>(number(at, count)); }
    bool says(std::uint64_t at, std::string_view text) const {
        return at <= bytes.size() && bytes.substr(at).starts_with(text);
    }
};

std::optional<PictureHead> pngHead(std::string_view content) {
    const HeadBytes file{content, false};
    if (!file.says(12, "IHDR")) return std::nullopt;
    return PictureHead{file.size(16, 4), file.size(20, 4), file.number(24, 1) == 16 ? 2 : 1};
}

// Goes from marker to marker until that of a frame. What lies between is passed over, as decoders do.
std::optional<PictureHead> jpegHead(std::string_view content) {
    constexpr std::uint64_t kFirstFrame = 0xC0, kLastFrame = 0xCF, kTables = 0xC4, kReserved = 0xC8,
                            kConditions = 0xCC, kStart = 0xD8, kEnd = 0xD9, kScan = 0xDA,
                            kFirstRestart = 0xD0, kAlone = 0x01;
    const HeadBytes file{content, false};
    for (std::uint64_t at = 2; at < content.size();) {
        at = content.find('\xff', at);
        if (at == std::string_view::npos) break;
        at = content.find_first_not_of('\xff', at);
        if (at == std::string_view::npos) break;
        const std::uint64_t marker = file.number(at++, 1);
        if (marker == 0 || marker == kAlone || (marker >= kFirstRestart && marker <= kStart)) continue;
        if (marker == kEnd || marker == kScan) break;
        const bool frame = marker >= kFirstFrame && marker <= kLastFrame && marker != kTables &&
                           marker != kReserved && marker != kConditions;
        if (frame) return PictureHead{file.size(at + 5, 2), file.size(at + 3, 2), 1};
        at += file.number(at, 2);
    }
    return std::nullopt;
}

std::optional<PictureHead> bmpHead(std::string_view content) {
    const HeadBytes file{content};
    const std::uint64_t head = file.number(14, 4);
    if (head == 12) return PictureHead{file.size(18, 2), file.size(20, 2), 1};
    if (head < 36) return std::nullopt;
    const auto width = static_cast<std::int32_t>(file.number(18, 4)),
               height = static_cast<std::int32_t>(file.number(22, 4));  // below 0: from the top down
    return PictureHead{width, std::llabs(height), 1};
}

std::optional<PictureHead> webpHead(std::string_view content) {
    const HeadBytes file{content};
    constexpr std::uint64_t k14Bits = 0x3fff;
    if (file.says(12, "VP8 "))
        return PictureHead{static_cast<long long>(file.number(26, 2) & k14Bits),
                           static_cast<long long>(file.number(28, 2) & k14Bits), 1};
    constexpr std::size_t kLosslessHead = 25, kExtendedHead = 30;  // sizes are kept less one: 0 would be one
    if (file.says(12, "VP8L") && content.size() >= kLosslessHead) {
        const std::uint64_t sides = file.number(21, 4);
        return PictureHead{static_cast<long long>(sides & k14Bits) + 1,
                           static_cast<long long>(sides >> 14 & k14Bits) + 1, 1};
    }
    if (file.says(12, "VP8X") && content.size() >= kExtendedHead)
        return PictureHead{file.size(24, 3) + 1, file.size(27, 3) + 1, 1};
    return std::nullopt;
}

// The first directory alone.
std::optional<PictureHead> tiffHead(std::string_view content) {
    constexpr std::uint64_t kWidth = 256, kHeight = 257, kBits = 258, kColours = 262, kShort = 3, kLong = 4,
                            kLong8 = 16, kLogarithms = 32844;  // logarithms of light: unpacked to floats
    constexpr std::uint64_t kMostFields = 4096;
    const HeadBytes file{content, content.starts_with("II")};
    const bool big = file.number(2, 2) == 43;
    const int word = big ? 8 : 4;  // bytes of a count and of a place
    const std::uint64_t directory = file.number(big ? 8 : 4, word), counted = big ? 8 : 2;
    const std::uint64_t fields = file.number(directory, static_cast<int>(counted));
    if (directory < 8 || fields == 0 || fields > kMostFields) return std::nullopt;
    PictureHead head;
    for (std::uint64_t n = 0; n < fields; ++n) {
        const std::uint64_t field = directory + counted + n * (big ? 20 : 12);
        const std::uint64_t tag = file.number(field, 2), type = file.number(field + 2, 2);
        if (tag != kWidth && tag != kHeight && tag != kBits && tag != kColours) continue;
        const int bytes = type == kShort ? 2 : type == kLong ? 4 : type == kLong8 && big ? 8 : 0;
        if (bytes == 0) return std::nullopt;
        const std::uint64_t count = file.number(field + 4, word);
        const std::uint64_t values = field + 4 + static_cast<std::uint64_t>(word);
        const bool inside = count <= static_cast<std::uint64_t>(word / bytes);
        const std::uint64_t value = file.number(inside ? values : file.number(values, word), bytes);
        if (tag == kBits)
            head.sampleBytes = std::max(head.sampleBytes, value <= 8 ? 1 : value <= 16 ? 2 : 4);
        else if (tag == kColours)
            head.sampleBytes = value >= kLogarithms ? 4 : head.sampleBytes;
        else
            (tag == kWidth ? head.width : head.height) =
                static_cast<long long>(std::min<std::uint64_t>(value, std::uint64_t{1} << 62));
    }
    return head;
}

}  // namespace

std::optional<PictureHead> pictureHeadOf(PictureFormat format, std::string_view content) {
    switch (format) {
        case PictureFormat::Png:
            return pngHead(content);
        case PictureFormat::Jpeg:
            return jpegHead(content);
        case PictureFormat::Tiff:
            return tiffHead(content);
        case PictureFormat::Bmp:
            return bmpHead(content);
        case PictureFormat::WebP:
            return webpHead(content);
        case PictureFormat::Radiance:
            break;
    }
    return std::nullopt;
}

}  // namespace stereonav
