// Writes DICOM files element by element (PS3.5 7, PS3.10 7), right or forged, without a library.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "file_bytes.h"
#include "slice_spec.h"

namespace stereonav::test {

enum class DicomSyntax { Implicit, Explicit, BigEndian, Deflated };

inline const char* uidOf(DicomSyntax syntax) {
    switch (syntax) {
        case DicomSyntax::Implicit:
            return "1.2.840.10008.1.2";
        case DicomSyntax::Explicit:
            return "1.2.840.10008.1.2.1";
        case DicomSyntax::BigEndian:
            return "1.2.840.10008.1.2.2";
        default:
            return "1.2.840.10008.1.2.1.99";
    }
}

// Elements in the order of the calls.
class DicomBytes {
public:
    explicit DicomBytes(DicomSyntax syntax) : mSyntax(syntax) {}

    const std::string& bytes() const { return mBytes; }
    bool big() const { return mSyntax == DicomSyntax::BigEndian; }

    std::string number(std::uint64_t value, int size) const {
        std::string text;
        for (int n = 0; n < size; ++n) text += static_cast<char>(value >> (8 * n));
        if (big()) std::reverse(text.begin(), text.end());
        return text;
    }
    std::string tag(std::uint32_t tag) const { return number(tag >> 16, 2) + number(tag & 0xffff, 2); }

    // `length`: the one to write, where it has to differ from the value's.
    void element(std::uint32_t tag_, const std::string& kind, const std::string& value,
                 std::int64_t length = -1) {
        const std::uint64_t said = length < 0 ? value.size() : static_cast<std::uint64_t>(length);
        mBytes += tag(tag_);
        const bool isLong = kind == "OB" || kind == "OW" || kind == "SQ" || kind == "UN";
        if (mSyntax == DicomSyntax::Implicit)
            mBytes += number(said, 4);
        else if (isLong)
            mBytes += kind + std::string(2, '\0') + number(said, 4);
        else
            mBytes += kind + number(said, 2);
        mBytes += value;
    }
    void text(std::uint32_t tag_, const std::string& kind, std::string value) {
        if (value.size() % 2) value += kind == "UI" ? '\0' : ' ';
        element(tag_, kind, value);
    }
    void word(std::uint32_t tag_, int value) {
        element(tag_, "US", number(static_cast<std::uint16_t>(value), 2));
    }
    // Returns an item of a sequence, of known length or not.
    std::string item(const std::string& content, bool known) const {
        if (known) return tag(0xfffee000) + number(content.size(), 4) + content;
        return tag(0xfffee000) + number(0xffffffff, 4) + content + tag(0xfffee00d) + number(0, 4);
    }
    void sequence(std::uint32_t tag_, const std::string& items, bool known) {
        if (known) return element(tag_, "SQ", items);
        element(tag_, "SQ", items + tag(0xfffee0dd) + number(0, 4), 0xffffffff);
    }

private:
    DicomSyntax mSyntax;
    std::string mBytes;
};

// Returns a file's head and the data set after it, packed where the syntax says so.
inline std::string dicomFile(DicomSyntax syntax, const std::string& set,
                             const std::string& mediaClass = "1.2.840.10008.5.1.4.1.1.2",
                             const std::string& otherSyntax = "") {
    DicomBytes head(DicomSyntax::Explicit);
    head.text(0x00020002, "UI", mediaClass);
    head.text(0x00020010, "UI", otherSyntax.empty() ? uidOf(syntax) : otherSyntax);
    std::string packed = set;
    if (syntax == DicomSyntax::Deflated) {
        z_stream stream{};
        deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
        packed.resize(deflateBound(&stream, set.size()) + 64);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(set.data()));
        stream.avail_in = static_cast<uInt>(set.size());
        stream.next_out = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_out = static_cast<uInt>(packed.size());
        deflate(&stream, Z_FINISH);
        packed.resize(stream.total_out);
        deflateEnd(&stream);
    }
    return std::string(128, '\0') + "DICM" + head.bytes() + packed;
}

// Description of a slice like SliceSpec, in any syntax, with more choices.
struct DicomSpec {
    SliceSpec slice;
    DicomSyntax syntax = DicomSyntax::Explicit;
    std::string imageType = "ORIGINAL\\PRIMARY\\AXIAL", sopClass = "1.2.840.10008.5.1.4.1.1.2";
    int samples = 1, bits = 16;       // bits allocated: 8, 16 or 32
    std::int64_t pixelLength = -1;    // a length other than the pixels'
    std::vector<glm::dvec3> frames;   // positions of the frames of an enhanced image
    bool knownLengths = true;         // whether lengths of sequences are known
    std::vector<double> intercepts;   // one per frame
    std::vector<std::string> packed;  // compressed pictures instead of pixels, one per frame
    std::string packedSyntax;
    int plainFrames = 0;                               // several frames without functional groups
    std::string spacingBetween, offsets, doseScaling;  // "" for none
    // Head of a modality LUT, three numbers, beside its bytes; there is no rescale then.
    std::vector<int> tableHead;
    std::vector<int> tableValues;
    int tableWidth = 2;    // bytes per entry
    bool rescaled = true;  // false: neither slope nor intercept
};

inline std::string pixelBytes(const DicomSpec& s, const DicomBytes& out) {
    std::vector<std::uint16_t> pixels = s.slice.pixels;
    const std::size_t frames =
        std::max<std::size_t>({s.frames.size(), static_cast<std::size_t>(s.plainFrames), 1});
    pixels.resize(static_cast<std::size_t>(s.slice.columns) * s.slice.rows * frames * s.samples, 1024);
    std::string bytes;
    for (const std::uint16_t x : pixels) bytes += out.number(x, s.bits / 8);
    if (bytes.size() % 2) bytes += '\0';
    return bytes;
}

inline void addFrameGroups(const DicomSpec& s, DicomBytes& out) {
    DicomBytes orientation(s.syntax), measures(s.syntax), shared(s.syntax);
    const SliceSpec& p = s.slice;
    orientation.text(0x00200037, "DS",
                     numbersText({p.along.x, p.along.y, p.along.z, p.down.x, p.down.y, p.down.z}));
    measures.text(0x00280030, "DS", numbersText({p.spacing.y, p.spacing.x}));
    shared.sequence(0x00209116, shared.item(orientation.bytes(), s.knownLengths), s.knownLengths);
    shared.sequence(0x00289110, shared.item(measures.bytes(), s.knownLengths), s.knownLengths);
    out.sequence(0x52009229, out.item(shared.bytes(), s.knownLengths), s.knownLengths);
    std::string items;
    for (std::size_t n = 0; n < s.frames.size(); ++n) {
        DicomBytes place(s.syntax), rescale(s.syntax), frame(s.syntax);
        place.text(0x00200032, "DS", numbersText({s.frames[n].x, s.frames[n].y, s.frames[n].z}));
        rescale.text(0x00281052, "DS", numbersText({n < s.intercepts.size() ? s.intercepts[n] : -1024.0}));
        rescale.text(0x00281053, "DS", "1");
        frame.sequence(0x00209113, frame.item(place.bytes(), s.knownLengths), s.knownLengths);
        frame.sequence(0x00289145, frame.item(rescale.bytes(), s.knownLengths), s.knownLengths);
        items += out.item(frame.bytes(), s.knownLengths);
    }
    out.sequence(0x52009230, items, s.knownLengths);
}

inline void addTable(const DicomSpec& s, DicomBytes& out) {
    DicomBytes table(s.syntax);
    std::string head, values;
    for (const int x : s.tableHead) head += out.number(static_cast<std::uint16_t>(x), 2);
    for (const int x : s.tableValues) values += out.number(static_cast<std::uint16_t>(x), s.tableWidth);
    if (values.size() % 2) values += '\0';
    table.element(0x00283002, "US", head);
    table.element(0x00283006, "OW", values);
    out.sequence(0x00283000, out.item(table.bytes(), s.knownLengths), s.knownLengths);
}

inline std::string dicomBytes(const DicomSpec& s) {
    DicomBytes out(s.syntax);
    const SliceSpec& p = s.slice;
    out.text(0x00080008, "CS", s.imageType);
    out.text(0x00080016, "UI", s.sopClass);
    out.text(0x00080060, "CS", p.modality);
    out.text(0x0008103e, "LO", p.description);
    if (!s.spacingBetween.empty()) out.text(0x00180088, "DS", s.spacingBetween);
    out.text(0x0020000e, "UI", p.uid);
    if (s.frames.empty()) {
        out.text(0x00200032, "DS", numbersText({p.position.x, p.position.y, p.position.z}));
        out.text(0x00200037, "DS",
                 numbersText({p.along.x, p.along.y, p.along.z, p.down.x, p.down.y, p.down.z}));
    }
    out.word(0x00280002, s.samples);
    out.text(0x00280004, "CS", s.samples == 3 ? "RGB" : p.photometric);
    if (!s.frames.empty()) out.text(0x00280008, "IS", std::to_string(s.frames.size()));
    if (s.plainFrames > 0) out.text(0x00280008, "IS", std::to_string(s.plainFrames));
    out.word(0x00280010, p.rows);
    out.word(0x00280011, p.columns);
    if (s.frames.empty()) out.text(0x00280030, "DS", numbersText({p.spacing.y, p.spacing.x}));
    out.word(0x00280100, s.bits);
    out.word(0x00280101, p.bitsStored);
    out.word(0x00280102, p.bitsStored - 1);
    out.word(0x00280103, p.isSigned ? 1 : 0);
    if (s.frames.empty() && s.rescaled) {
        out.text(0x00281052, "DS", p.intercept);
        out.text(0x00281053, "DS", p.slope);
    }
    if (!s.tableHead.empty()) addTable(s, out);
    if (!s.offsets.empty()) out.text(0x3004000c, "DS", s.offsets);
    if (!s.doseScaling.empty()) out.text(0x3004000e, "DS", s.doseScaling);
    if (!s.frames.empty()) addFrameGroups(s, out);
    if (s.packed.empty()) {
        out.element(0x7fe00010, "OW", pixelBytes(s, out), s.pixelLength);
        return dicomFile(s.syntax, out.bytes(), s.sopClass);
    }
    std::string items = out.item("", true);  // no table of offsets
    for (const std::string& picture : s.packed) items += out.item(picture, true);
    out.element(0x7fe00010, "OB", items + out.tag(0xfffee0dd) + out.number(0, 4), 0xffffffff);
    return dicomFile(s.syntax, out.bytes(), s.sopClass, s.packedSyntax);
}

inline void writeDicom(const std::filesystem::path& file, const DicomSpec& s) {
    std::filesystem::create_directories(file.parent_path());
    writeBytes(file, dicomBytes(s));
}

}  // namespace stereonav::test
