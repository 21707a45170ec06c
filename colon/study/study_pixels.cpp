// Pixels of DICOM files: those that are stored as they are straight from the file, others through GDCM, after
// a look at the heads of their compressed pictures, which codecs believe whatever the file around them says.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <string_view>

#include "colon/study/picture_decoder.h"
#include "colon/study/study_dicom_file.h"
#include "colon/study/study_parts.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

[[noreturn]] void refusePixels(const fs::path& file, const std::string& problem,
                               const char* advice = "copy the file again") {
    throw Error(file.string(), "", problem, advice);
}

// How whole numbers lie in the bytes (PS3.5 8.1.1).
struct PixelLayout {
    int bits = 16, shift = 0, stored = 16;
    bool isSigned = false, turned = false;
};

PixelLayout layoutOf(const fs::path& path, const DicomFile& file) {
    PixelLayout layout;
    layout.bits = file.word(0x00280100, 16);
    if (layout.bits != 8 && layout.bits != 16 && layout.bits != 32)
        refusePixels(path,
                     fmt::format("expected whole numbers of 8, 16 or 32 bits a pixel, found {}", layout.bits),
                     "convert it to 16 bits");
    layout.stored = file.word(0x00280101, layout.bits);
    const int high = file.word(0x00280102, layout.stored - 1);
    if (layout.stored < 1 || layout.stored > layout.bits || high < layout.stored - 1 || high >= layout.bits)
        refusePixels(path, fmt::format("expected bits of a pixel within its {}, found {} up to bit {}",
                                       layout.bits, layout.stored, high));
    layout.shift = high + 1 - layout.stored;
    layout.isSigned = file.word(0x00280103, 0) == 1;
    layout.turned = file.bigEndian() != (std::endian::native == std::endian::big);
    return layout;
}

template <typename T>
void widen(const void* from, std::size_t count, const PixelLayout& layout, std::vector<double>& to) {
    const int unused = static_cast<int>(8 * sizeof(T)) - layout.stored;
    const auto* bytes = static_cast<const unsigned char*>(from);
    for (std::size_t n = 0; n < count; ++n) {
        unsigned char each[sizeof(T)];
        std::memcpy(each, bytes + n * sizeof(T), sizeof(T));
        if (layout.turned) std::reverse(each, each + sizeof(T));
        T number;
        std::memcpy(&number, each, sizeof(T));
        const T upper = static_cast<T>(static_cast<T>(number >> layout.shift) << unused);
        to[n] = layout.isSigned ? static_cast<double>(static_cast<std::make_signed_t<T>>(upper) >> unused)
                                : static_cast<double>(static_cast<T>(upper >> unused));
    }
}

void widenAny(const void* from, std::size_t count, const PixelLayout& layout, std::vector<double>& to) {
    to.resize(count);
    if (layout.bits == 8) return widen<std::uint8_t>(from, count, layout, to);
    if (layout.bits == 16) return widen<std::uint16_t>(from, count, layout, to);
    widen<std::uint32_t>(from, count, layout, to);
}

// Bytes of a compressed picture, most significant first.
struct Codestream {
    std::string_view bytes;

    std::uint64_t size() const { return bytes.size(); }
    std::uint32_t one(std::uint64_t at) const {
        return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0u;
    }
    std::uint32_t two(std::uint64_t at) const { return one(at) << 8 | one(at + 1); }
    std::uint64_t four(std::uint64_t at) const {
        return static_cast<std::uint64_t>(two(at)) << 16 | two(at + 2);
    }
};

struct PictureSize {
    std::uint64_t columns = 0, rows = 0;
    std::uint32_t bits = 0, components = 1;
    bool sound = true;
};

// Returns the size in the frame header of JPEG and JPEG-LS (ITU-T T.81 B.2.2, T.87 C.2.2); nothing where
// there is no such header.
std::optional<PictureSize> jpegSize(const Codestream& code) {
    std::uint64_t at = 2;
    while (at + 4 <= code.size()) {
        const std::uint32_t marker = code.two(at);
        if (marker == 0xffff) {
            ++at;
            continue;
        }
        if (marker >> 8 != 0xff) return {};
        const bool frame = (marker >= 0xffc0 && marker <= 0xffcf && marker != 0xffc4 && marker != 0xffc8 &&
                            marker != 0xffcc) ||
                           marker == 0xfff7;
        if (frame) return PictureSize{code.two(at + 7), code.two(at + 5), code.one(at + 4), code.one(at + 9)};
        at += 2 + code.two(at + 2);
    }
    return {};
}

// The size in JPEG 2000's SIZ marker (ITU-T T.800 A.5.1), which may lie within boxes.
std::optional<PictureSize> jpeg2000Size(const Codestream& code) {
    constexpr std::uint64_t kFarthest = 4096;
    for (std::uint64_t at = 0; at + 40 <= code.size() && at < kFarthest; ++at) {
        if (code.two(at) != 0xff4f || code.two(at + 2) != 0xff51) continue;
        const std::uint64_t x = code.four(at + 8), y = code.four(at + 12), x0 = code.four(at + 16),
                            y0 = code.four(at + 20), tileX = code.four(at + 24), tileY = code.four(at + 28);
        if (x <= x0 || y <= y0 || tileX == 0 || tileY == 0) return {};
        const bool sound = (x / tileX + 1) * (y / tileY + 1) <= 65535;  // tiles
        return PictureSize{x - x0, y - y0, (code.one(at + 42) & 0x7f) + 1, code.two(at + 40), sound};
    }
    return {};
}

// Returns whether RLE's offsets of segments (PS3.5 G.5) are sound, one for each byte of a pixel.
bool isRleSound(std::string_view bytes, int bits) {
    constexpr std::uint64_t kHead = 64;
    const auto number = [&](std::uint64_t n) {
        std::uint64_t value = 0;
        for (std::uint64_t byte = 0; byte < 4; ++byte)
            value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[4 * n + byte]))
                     << (8 * byte);
        return value;
    };
    if (bytes.size() < kHead || number(0) != static_cast<std::uint64_t>(bits / 8)) return false;
    for (std::uint64_t n = 1; n <= number(0); ++n)
        if (number(n) < kHead || number(n) > bytes.size() || (n > 1 && number(n) < number(n - 1)))
            return false;
    return true;
}

void checkSyntax(const fs::path& path, const std::string& syntax) {
    static constexpr const char* kKnown[] = {
        "1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.51", "1.2.840.10008.1.2.4.57",
        "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.81",
        "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91", "1.2.840.10008.1.2.5"};
    if (std::none_of(std::begin(kKnown), std::end(kKnown),
                     [&](const char* known) { return syntax == known; }))
        refusePixels(
            path,
            fmt::format("its pixels are encoded in a way that is not read (transfer syntax {})", syntax),
            "convert it to JPEG 2000, JPEG-LS, JPEG lossless, RLE or none");
}

void checkPicture(const PackedPicture& picture) {
    const fs::path& path = picture.file;
    if (picture.syntax.ends_with(".1.2.5")) {
        if (picture.parts.size() != 1 || !isRleSound(picture.parts[0], picture.bits))
            refusePixels(path, "cut off or damaged: the parts of its pixels do not fit");
        return;
    }
    const bool second = picture.syntax.ends_with(".90") || picture.syntax.ends_with(".91");
    const Codestream code{picture.parts[0]};
    const auto size = second ? jpeg2000Size(code) : jpegSize(code);
    if (!size) refusePixels(path, "cut off or damaged: its compressed pixels have no header");
    if (size->columns != static_cast<std::uint64_t>(picture.columns) ||
        size->rows != static_cast<std::uint64_t>(picture.rows))
        refusePixels(
            path, fmt::format("damaged: its compressed picture has {} x {} pixels, the header says {} x {}",
                              size->columns, size->rows, picture.columns, picture.rows));
    if (size->bits < 2 || size->bits > static_cast<std::uint32_t>(picture.bits) || size->components != 1)
        refusePixels(
            path, fmt::format("damaged: its compressed picture has {} numbers of {} bits a pixel, the header "
                              "says one of {}",
                              size->components, size->bits, picture.bits));
    if (!size->sound) refusePixels(path, "damaged: its compressed picture is cut into too many tiles");
}

using Parts = std::vector<std::string_view>;

// The parts of each frame: one each, or as the table of offsets says.
std::vector<Parts> partsOfFrames(const fs::path& path, const DicomFile& file, int frames) {
    const auto& fragments = file.pixels().fragments;
    const auto part = [&](std::size_t n) {
        return std::string_view(reinterpret_cast<const char*>(file.data()) + fragments[n].first,
                                fragments[n].second);
    };
    std::vector<Parts> parts(static_cast<std::size_t>(frames));
    const std::size_t count = fragments.size() - 1;
    if (frames == 1 || count == parts.size()) {
        for (std::size_t n = 0; n < count; ++n) parts[frames == 1 ? 0 : n].push_back(part(n + 1));
        return parts;
    }
    const std::string_view table = part(0);
    const auto offset = [&](std::size_t frame) {
        std::uint64_t value = 0;
        for (std::size_t byte = 0; byte < 4; ++byte)
            value |= static_cast<std::uint64_t>(static_cast<unsigned char>(table[4 * frame + byte]))
                     << (8 * byte);
        return value;
    };
    const bool told = table.size() == 4 * parts.size();
    std::size_t frame = 0;
    for (std::size_t n = 1; told && n <= count; ++n) {
        const std::uint64_t start = fragments[n].first - fragments[1].first;
        while (frame + 1 < parts.size() && offset(frame + 1) <= start) ++frame;
        parts[frame].push_back(part(n));
    }
    if (!told || std::any_of(parts.begin(), parts.end(), [](const Parts& p) { return p.empty(); }))
        refusePixels(path,
                     fmt::format("damaged: it says {} frames, its pixels are in {} parts", frames, count));
    return parts;
}

}  // namespace

void decodeSlices(const std::vector<const DicomSlice*>& slices, PictureDecoder& decoder,
                  const std::function<void(const DicomSlice&, const double*)>& use) {
    const DicomSlice& first = *slices.front();
    const DicomFile file(first.file);
    if (!file.damage().empty() || !file.pixels().found)
        refusePixels(first.file, "has changed since it was looked through");
    const std::uint64_t count = static_cast<std::uint64_t>(first.columns) * first.rows;
    const PixelLayout layout = layoutOf(first.file, file);
    std::vector<Parts> parts;
    if (file.pixels().encapsulated) {
        checkSyntax(first.file, file.syntax());
        parts = partsOfFrames(first.file, file, first.frames);
    }
    // Words of 16 bits: a big-endian file turns each of them over, whatever the pixels are (PS3.5 6.2, OW).
    const std::uint64_t each = static_cast<std::uint64_t>(layout.bits / 8);
    const bool inWords = parts.empty() && each != 2 && file.bigEndian() && file.pixels().words;
    PixelLayout little = layout;
    little.turned = std::endian::native == std::endian::big;
    std::vector<unsigned char> bytes;
    std::vector<double> values;
    for (const DicomSlice* slice : slices) {
        const auto frame = static_cast<std::size_t>(std::max(slice->frame, 0));
        if (inWords) {
            const unsigned char* pixels = file.data() + file.pixels().at;
            const std::uint64_t last = file.pixels().bytes - 1;
            bytes.resize(count * each);
            for (std::uint64_t n = 0; n < bytes.size(); ++n)
                bytes[n] = pixels[std::min((frame * bytes.size() + n) ^ 1, last)];
            widenAny(bytes.data(), count, little, values);
        } else if (parts.empty()) {
            widenAny(file.data() + file.pixels().at + frame * count * (layout.bits / 8), count, layout,
                     values);
        } else {
            PackedPicture picture{first.file,
                                  file.syntax(),
                                  first.columns,
                                  first.rows,
                                  layout.bits,
                                  layout.stored,
                                  layout.shift + layout.stored - 1,
                                  layout.isSigned,
                                  parts[frame]};
            checkPicture(picture);
            const DecodedPixels decoded = decoder.decode(picture);
            widenAny(decoded.bytes.data(), count,
                     PixelLayout{decoded.bits, 0, decoded.bits, decoded.isSigned, false}, values);
        }
        use(*slice, values.data());
    }
}

}  // namespace stereonav
