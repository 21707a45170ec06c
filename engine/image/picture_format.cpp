#include "engine/image/picture_format.h"

namespace stereonav {
namespace {

using namespace std::string_view_literals;

struct FirstBytes {
    std::string_view bytes;
    PictureFormat format;
};
constexpr FirstBytes kFirstBytes[] = {
    {"\x89PNG\r\n\x1a\n"sv, PictureFormat::Png},
    {"\xff\xd8\xff"sv, PictureFormat::Jpeg},
    {"II*\0"sv, PictureFormat::Tiff},
    {"MM\0*"sv, PictureFormat::Tiff},
    {"II+\0"sv, PictureFormat::Tiff},  // BigTIFF, for more than 4 GB
    {"MM\0+"sv, PictureFormat::Tiff},
    {"BM"sv, PictureFormat::Bmp},
    {"#?"sv, PictureFormat::Radiance},
};

}  // namespace

std::optional<PictureFormat> pictureFormatOf(std::string_view content) {
    for (const FirstBytes& known : kFirstBytes)
        if (content.starts_with(known.bytes)) return known.format;
    if (content.starts_with("RIFF") && content.substr(4).substr(0, 8).ends_with("WEBP"))
        return PictureFormat::WebP;
    return std::nullopt;
}

bool isPictureSize(long long width, long long height) {
    return width >= 1 && height >= 1 && width <= kMostPictureSide && height <= kMostPictureSide &&
           width * height <= kMostPicturePixels;
}

}  // namespace stereonav
