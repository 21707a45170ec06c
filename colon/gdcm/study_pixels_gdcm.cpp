// Pixels that are compressed (JPEG, JPEG-LS, JPEG 2000, RLE), through GDCM.
#include <fmt/format.h>
#include <gdcmGlobal.h>
#include <gdcmImageReader.h>
#include <gdcmTrace.h>

#include <mutex>
#include <sstream>

#include "colon/gdcm/quiet_thread.h"
#include "colon/study_module.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

// Builds its dictionaries at first use, on one thread only.
void prepareGdcm() {
    static std::once_flag once;
    std::call_once(once, [] {
        gdcm::Trace::DebugOff();
        gdcm::Trace::WarningOff();
        gdcm::Trace::ErrorOff();
        gdcm::Global::GetInstance().LoadResourcesFiles();
    });
}

// Appends numbers with the least byte first, as explicit little-endian files have them.
void append(std::string& bytes, std::uint64_t number, int count) {
    for (int n = 0; n < count; ++n) bytes += static_cast<char>(number >> (8 * n));
}

void appendElement(std::string& bytes, std::uint32_t tag, const char* kind, std::string value) {
    if (value.size() % 2) value += std::string(kind) == "UI" ? '\0' : ' ';
    append(bytes, tag >> 16, 2);
    append(bytes, tag & 0xffff, 2);
    bytes += kind;
    append(bytes, value.size(), 2);
    bytes += value;
}

void appendWord(std::string& bytes, std::uint32_t tag, int value) {
    std::string word;
    append(word, static_cast<std::uint64_t>(value), 2);
    appendElement(bytes, tag, "US", word);
}

// A file of our own around the picture: what GDCM takes apart is sound, whatever the picture came in.
std::string fileOf(const PackedPicture& picture) {
    std::string bytes = std::string(128, '\0') + "DICM", head;
    appendElement(head, 0x00020002, "UI", "1.2.840.10008.5.1.4.1.1.2");
    appendElement(head, 0x00020003, "UI", "1.2.3");
    appendElement(head, 0x00020010, "UI", picture.syntax);
    std::string length;
    append(length, head.size(), 4);
    appendElement(bytes, 0x00020000, "UL", length);
    bytes += head;
    appendElement(bytes, 0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
    appendElement(bytes, 0x00080018, "UI", "1.2.3");
    appendWord(bytes, 0x00280002, 1);
    appendElement(bytes, 0x00280004, "CS", "MONOCHROME2");
    appendWord(bytes, 0x00280010, picture.rows);
    appendWord(bytes, 0x00280011, picture.columns);
    appendWord(bytes, 0x00280100, picture.bits);
    appendWord(bytes, 0x00280101, picture.stored);
    appendWord(bytes, 0x00280102, picture.high);
    appendWord(bytes, 0x00280103, picture.isSigned ? 1 : 0);
    bytes += std::string("\xe0\x7f\x10\x00OB\0\0\xff\xff\xff\xff", 12);
    bytes += std::string("\xfe\xff\x00\xe0\0\0\0\0", 8);  // no table of offsets
    for (const std::string_view part : picture.parts) {
        bytes += std::string("\xfe\xff\x00\xe0", 4);
        append(bytes, part.size() + part.size() % 2, 4);
        bytes += part;
        if (part.size() % 2) bytes += '\0';
    }
    bytes += std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
    return bytes;
}

void takeFormat(const std::filesystem::path& file, const gdcm::PixelFormat& format, DecodedPixels& pixels) {
    switch (format.GetScalarType()) {
        case gdcm::PixelFormat::UINT8:
        case gdcm::PixelFormat::INT8:
            pixels.bits = 8;
            break;
        case gdcm::PixelFormat::UINT12:
        case gdcm::PixelFormat::UINT16:
        case gdcm::PixelFormat::INT12:
        case gdcm::PixelFormat::INT16:
            pixels.bits = 16;
            break;
        case gdcm::PixelFormat::UINT32:
        case gdcm::PixelFormat::INT32:
            pixels.bits = 32;
            break;
        default:
            throw Error(file.string(), "",
                        "expected whole numbers of 8 to 32 bits a pixel, found another type",
                        "convert it to 16 bits");
    }
    pixels.isSigned = format.GetPixelRepresentation() == 1;
}

}  // namespace

DecodedPixels decodePicture(const PackedPicture& picture) {
    // One at a time: a run that decoded damaged pictures on several threads ended within the codecs.
    static std::mutex codecs;
    const std::lock_guard lock(codecs);
    const QuietThread quiet;
    prepareGdcm();
    const auto fail = [&](const std::string& problem) {
        throw Error(picture.file.string(), "", problem, "copy the file again");
    };
    DecodedPixels pixels;
    std::istringstream file(fileOf(picture));
    gdcm::ImageReader reader;
    reader.SetStream(file);
    try {
        if (!reader.Read()) fail("cut off or damaged: its pixels can not be read");
        const gdcm::Image& image = reader.GetImage();
        takeFormat(picture.file, image.GetPixelFormat(), pixels);
        const std::uint64_t expected = static_cast<std::uint64_t>(picture.columns) *
                                       static_cast<std::uint64_t>(picture.rows) *
                                       static_cast<std::uint64_t>(pixels.bits / 8);
        if (image.GetBufferLength() != expected)
            fail(fmt::format("cut off: expected {} bytes of pixels, found {}", expected,
                             image.GetBufferLength()));
        pixels.bytes.resize(expected);
        if (!image.GetBuffer(pixels.bytes.data())) fail("cut off or damaged: its pixels can not be decoded");
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail(std::string("can not be decoded: ") + error.what());
    }
    return pixels;
}

}  // namespace stereonav
