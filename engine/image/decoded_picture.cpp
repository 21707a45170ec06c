#include "engine/image/decoded_picture.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/helper_pool.h"
#include "engine/base/memory.h"
#include "engine/image/picture_reader/image_request.h"

namespace stereonav {
namespace {

constexpr int kSamplesPerPixel = 3;
constexpr const char* kCopyAgain = "copy or export it again";

// One is kept: the pictures of a mesh, or of a page, are read one after the other.
HelperPool& pictureReaders() {
    static HelperPool pool("picture_reader", "to read pictures", 1);
    return pool;
}

// The decoders show the upper part of a cut-off JPEG as if it were whole, so it is looked at for its end: the
// marker (FFD9) comes after that of the last scan (FFDA). A PNG closes with the chunk IEND.
bool isCutOff(PictureFormat format, std::string_view content) {
    if (format == PictureFormat::Jpeg) {
        const auto scan = content.rfind("\xff\xda");
        return scan == std::string_view::npos || content.find("\xff\xd9", scan) == std::string_view::npos;
    }
    return format == PictureFormat::Png && content.rfind("IEND") == std::string_view::npos;
}

// bytes: in both processes.
void checkSize(const PictureHead& head, double bytes, const std::string& file, const std::string& place) {
    if (!isPictureSize(head.width, head.height))
        throw Error(file, place,
                    fmt::format("expected a picture of at most {} pixels a side and {} in all, got {} x {}",
                                kMostPictureSide, kMostPicturePixels, head.width, head.height),
                    "make it smaller");
    checkMemory(place.empty() ? file : file + ":" + place, bytes, "make the picture smaller");
}

}  // namespace

std::optional<DecodedPicture> decodedPictureOf(std::string answer, const PictureHead& head) {
    ImageAnswer told;
    if (answer.size() < sizeof told) return std::nullopt;
    std::memcpy(&told, answer.data() + answer.size() - sizeof told, sizeof told);
    answer.resize(answer.size() - sizeof told);
    const bool upright = told.width == head.width && told.height == head.height;
    const bool onItsSide = told.width == head.height && told.height == head.width;
    if (!isPictureSize(told.width, told.height) || (!upright && !onItsSide)) return std::nullopt;
    if (told.sampleBytes != 1 && told.sampleBytes != 2 && told.sampleBytes != 4) return std::nullopt;
    const std::uint64_t samples =
        static_cast<std::uint64_t>(told.width) * static_cast<std::uint64_t>(told.height) * kSamplesPerPixel;
    if (answer.size() != samples * static_cast<std::uint64_t>(told.sampleBytes)) return std::nullopt;
    return DecodedPicture{told.width, told.height, told.sampleBytes, std::move(answer)};
}

DecodedPicture decodePicture(PictureFormat format, std::string_view content, std::size_t pixelBytes,
                             const std::string& file, const std::string& place) {
    const auto fail = [&](const std::string& problem) { return Error(file, place, problem, kCopyAgain); };
    if (isCutOff(format, content)) throw fail("is cut off: its end is missing");
    if (content.size() > std::numeric_limits<std::int32_t>::max()) throw fail("is larger than 2 GB");
    const std::optional<PictureHead> head = pictureHeadOf(format, content);
    if (!head) throw fail("is cut off or damaged: it does not say how large it is");
    // The file and its samples with their copies on the way, and what is made of them.
    constexpr int kCopies = 3;
    const int samples = kSamplesPerPixel * head->sampleBytes;
    const double count = static_cast<double>(head->width) * static_cast<double>(head->height);
    checkSize(*head,
              kCopies * static_cast<double>(content.size()) +
                  count * (kCopies * samples + static_cast<double>(pixelBytes)),
              file, place);
    const ImageRequest asked{format, static_cast<std::int32_t>(head->width),
                             static_cast<std::int32_t>(head->height)};
    std::string request(reinterpret_cast<const char*>(&asked), sizeof asked);
    request += content;
    const auto pixels = static_cast<std::uint64_t>(head->width * head->height);
    const HelperLimits limits = limitsForPicture(
        pixels, request.size(), pixels * static_cast<std::uint64_t>(samples) + sizeof(ImageAnswer));
    HelperAnswer answer = pictureReaders().ask(std::filesystem::path(file).parent_path(), request, limits);
    if (answer.kind == HelperAnswer::Kind::Ended)
        throw fail("damaged: the program that unpacks it was ended by it (" + answer.text + ")");
    if (answer.kind == HelperAnswer::Kind::Refused) throw fail(answer.text);
    std::optional<DecodedPicture> picture = decodedPictureOf(std::move(answer.text), *head);
    if (!picture) throw fail("damaged: it is not unpacked to the picture that it says it is");
    return *std::move(picture);
}

}  // namespace stereonav
