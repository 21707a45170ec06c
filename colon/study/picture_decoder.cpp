#include "colon/study/picture_decoder.h"

#include <cstring>

#include "colon/study/gdcm/picture_request.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

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

std::unique_ptr<HelperProgram> PictureDecoder::takeHelper() {
    {
        const std::lock_guard lock(mLock);
        if (!mIdle.empty()) {
            std::unique_ptr<HelperProgram> helper = std::move(mIdle.back());
            mIdle.pop_back();
            return helper;
        }
    }
    return std::make_unique<HelperProgram>("gdcm", "to unpack DICOM pictures");
}

DecodedPixels PictureDecoder::decode(const PackedPicture& picture) {
    constexpr std::uint64_t kWidestPixel = 4;  // bytes
    const std::uint64_t count =
        static_cast<std::uint64_t>(picture.columns) * static_cast<std::uint64_t>(picture.rows);
    const auto fail = [&](const std::string& problem) {
        return Error(picture.file.string(), "", problem, "copy the file again");
    };
    std::unique_ptr<HelperProgram> helper = takeHelper();
    HelperAnswer answer = helper->ask(requestOf(picture), kWidestPixel * count + sizeof(PictureAnswer));
    // One that met damage keeps what it took for it, and is not asked again.
    if (answer.kind == HelperAnswer::Kind::Ended)
        throw fail("damaged: the program that decodes its pixels was ended by them (" + answer.text + ")");
    if (answer.kind == HelperAnswer::Kind::Refused) throw fail(answer.text);
    {
        const std::lock_guard lock(mLock);
        mIdle.push_back(std::move(helper));
    }
    PictureAnswer told;
    if (answer.text.size() < sizeof told) throw fail("damaged: its pixels can not be decoded");
    DecodedPixels pixels{std::move(answer.text)};
    std::memcpy(&told, pixels.bytes.data() + pixels.bytes.size() - sizeof told, sizeof told);
    pixels.bytes.resize(pixels.bytes.size() - sizeof told);
    pixels.bits = told.bits;
    pixels.isSigned = told.isSigned;
    if (pixels.bytes.size() != count * static_cast<std::uint64_t>(told.bits / 8))
        throw fail("damaged: its pixels can not be decoded");
    return pixels;
}

}  // namespace stereonav
