// The helper stereonav_gdcm: unpacks compressed pictures (JPEG, JPEG-LS, JPEG 2000, RLE) through GDCM. Its
// codecs read past the end of damaged pictures, leave memory behind and print: all of that stays in this
// process.
#include <gdcmImageReader.h>
#include <gdcmTrace.h>

#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "colon/study/gdcm/picture_request.h"
#include "engine/helper/serve_requests.h"

namespace stereonav {
namespace {

struct Picture {
    PictureRequest head;
    std::vector<std::string_view> parts;
};

Picture pictureOf(std::string_view request) {
    const std::runtime_error wrong("expected a whole request");
    Picture picture;
    const auto take = [&](void* to, std::size_t count) {
        if (request.size() < count) throw wrong;
        std::memcpy(to, request.data(), count);
        request.remove_prefix(count);
    };
    take(&picture.head, sizeof picture.head);
    if (picture.head.parts > request.size() / sizeof(std::uint64_t)) throw wrong;
    std::vector<std::uint64_t> lengths(picture.head.parts);
    take(lengths.data(), lengths.size() * sizeof(std::uint64_t));
    for (const std::uint64_t length : lengths) {
        if (request.size() < length) throw wrong;
        picture.parts.push_back(request.substr(0, length));
        request.remove_prefix(length);
    }
    return picture;
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

// Returns a file of our own around the picture, so that the file which GDCM parses is sound, whatever file
// the picture came in.
std::string fileOf(const Picture& packed) {
    const PictureRequest& picture = packed.head;
    std::string bytes = std::string(128, '\0') + "DICM", head;
    appendElement(head, 0x00020002, "UI", "1.2.840.10008.5.1.4.1.1.2");
    appendElement(head, 0x00020003, "UI", "1.2.3");
    appendElement(head, 0x00020010, "UI", picture.syntax.data());
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
    for (const std::string_view part : packed.parts) {
        bytes += std::string("\xfe\xff\x00\xe0", 4);
        append(bytes, part.size() + part.size() % 2, 4);
        bytes += part;
        if (part.size() % 2) bytes += '\0';
    }
    bytes += std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
    return bytes;
}

PictureAnswer answerOf(const gdcm::PixelFormat& format) {
    PictureAnswer answer;
    switch (format.GetScalarType()) {
        case gdcm::PixelFormat::UINT8:
        case gdcm::PixelFormat::INT8:
            answer.bits = 8;
            break;
        case gdcm::PixelFormat::UINT12:
        case gdcm::PixelFormat::UINT16:
        case gdcm::PixelFormat::INT12:
        case gdcm::PixelFormat::INT16:
            answer.bits = 16;
            break;
        case gdcm::PixelFormat::UINT32:
        case gdcm::PixelFormat::INT32:
            answer.bits = 32;
            break;
        default:
            throw std::runtime_error("expected whole numbers of 8 to 32 bits a pixel, found another type");
    }
    answer.isSigned = format.GetPixelRepresentation() == 1;
    return answer;
}

std::string decode(std::string_view request) {
    const Picture picture = pictureOf(request);
    const std::uint64_t count =
        static_cast<std::uint64_t>(picture.head.columns) * static_cast<std::uint64_t>(picture.head.rows);
    std::istringstream file(fileOf(picture));
    gdcm::ImageReader reader;
    reader.SetStream(file);
    if (!reader.Read()) throw std::runtime_error("cut off or damaged: its pixels can not be read");
    const gdcm::Image& image = reader.GetImage();
    const PictureAnswer answer = answerOf(image.GetPixelFormat());
    const std::uint64_t expected = count * static_cast<std::uint64_t>(answer.bits / 8);
    if (image.GetBufferLength() != expected)
        throw std::runtime_error("cut off: expected " + std::to_string(expected) +
                                 " bytes of pixels, found " + std::to_string(image.GetBufferLength()));
    std::string bytes(expected + sizeof answer, '\0');
    if (!image.GetBuffer(bytes.data()))
        throw std::runtime_error("cut off or damaged: its pixels can not be decoded");
    std::memcpy(bytes.data() + expected, &answer, sizeof answer);
    return bytes;
}

// Nothing but refusals comes out of here, each one line.
std::string decodeOrRefuse(std::string_view request) {
    try {
        return decode(request);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(
            "damaged: decoding its pixels takes more memory than pictures of its size do");
    }
}

}  // namespace
}  // namespace stereonav

int main() {
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    return stereonav::serveRequests(stereonav::decodeOrRefuse);
}
