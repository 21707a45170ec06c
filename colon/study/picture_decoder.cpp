#include "colon/study/picture_decoder.h"

#include <cstring>
#include <limits>
#include <utility>

#include "colon/study/gdcm/picture_request.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"

namespace stereonav {
namespace {

constexpr std::size_t kEachThreads = std::numeric_limits<std::size_t>::max();  // one for each is kept

void append(std::string& bytes, const void* from, std::size_t count) {
    bytes.append(static_cast<const char*>(from), count);
}

std::string requestOf(const PackedPicture& picture) {
    PictureRequest head;
    picture.syntax.copy(head.syntax.data(), head.syntax.size() - 1);
    head.columns = picture.columns;
    head.rows = picture.rows;
    head.bits = picture.bits;
    head.stored = picture.stored;
    head.high = picture.high;
    head.isSigned = picture.isSigned;
    head.parts = picture.parts.size();
    std::string bytes;
    append(bytes, &head, sizeof head);
    for (const std::string_view part : picture.parts) {
        const std::uint64_t length = part.size();
        append(bytes, &length, sizeof length);
    }
    for (const std::string_view part : picture.parts) bytes += part;
    return bytes;
}

}  // namespace

std::optional<DecodedPixels> pixelsOf(std::string answer, std::uint64_t count) {
    PictureAnswer told;
    if (answer.size() < sizeof told) return std::nullopt;
    std::memcpy(&told, answer.data() + answer.size() - sizeof told, sizeof told);
    answer.resize(answer.size() - sizeof told);
    const bool wholeNumbers = told.bits == 8 || told.bits == 16 || told.bits == 32;
    if (!wholeNumbers || (told.isSigned != 0 && told.isSigned != 1)) return std::nullopt;
    const auto bytes = static_cast<std::uint64_t>(told.bits / 8);
    if (answer.size() / bytes != count || answer.size() % bytes != 0) return std::nullopt;
    return DecodedPixels{std::move(answer), told.bits, told.isSigned == 1};
}

PictureDecoder::PictureDecoder() : mHelpers("gdcm", "to unpack DICOM pictures", kEachThreads) {}

DecodedPixels PictureDecoder::decode(const PackedPicture& picture) {
    constexpr std::uint64_t kWidestPixel = 4;  // bytes
    constexpr double kWorthAsking = 1e8;
    const std::uint64_t count =
        static_cast<std::uint64_t>(picture.columns) * static_cast<std::uint64_t>(picture.rows);
    const auto fail = [&](const std::string& problem) {
        return Error(picture.file.string(), "", problem, "copy the file again");
    };
    // In both processes, and as numbers of this program. Most are too small to ask for.
    const double bytes = static_cast<double>(count) * (3 * kWidestPixel + sizeof(double));
    if (bytes > kWorthAsking) checkMemory(picture.file.string(), bytes, "take another series");
    const std::string request = requestOf(picture);
    const HelperLimits limits =
        limitsForPicture(count, request.size(), kWidestPixel * count + sizeof(PictureAnswer));
    HelperAnswer answer = mHelpers.ask("", request, limits);
    if (answer.kind == HelperAnswer::Kind::Ended)
        throw fail("damaged: the program that decodes its pixels was ended by them (" + answer.text + ")");
    if (answer.kind == HelperAnswer::Kind::Refused) throw fail(answer.text);
    std::optional<DecodedPixels> pixels = pixelsOf(std::move(answer.text), count);
    if (!pixels) throw fail("damaged: its pixels can not be decoded");
    return *std::move(pixels);
}

}  // namespace stereonav
