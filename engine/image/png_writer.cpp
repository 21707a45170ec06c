#include "engine/image/png_writer.h"

#include <png.h>
#include <zlib.h>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr int kLevel = 4;  // level of deflate: 1 fastest .. 9 smallest

[[noreturn]] void failPng(png_structp, png_const_charp) {
    throw Error("", "picture", "can not be compressed", "free memory");
}

struct PngEncoder {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, failPng, nullptr);
    png_infop info = png_create_info_struct(png);

    PngEncoder() = default;
    PngEncoder(const PngEncoder&) = delete;
    PngEncoder& operator=(const PngEncoder&) = delete;
    ~PngEncoder() { png_destroy_write_struct(&png, &info); }
};

void appendBytes(png_structp png, png_bytep data, std::size_t count) {
    auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
    bytes.insert(bytes.end(), data, data + count);
}

}  // namespace

std::vector<unsigned char> pngBytes(const Plane<PackedColor>& image) {
    if (image.empty())
        throw Error("", "picture", "expected at least one pixel, got none", "choose a larger size");
    Bytes bytes;
    const PngEncoder to;
    png_set_write_fn(to.png, &bytes, appendBytes, nullptr);
    png_set_user_limits(to.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(to.png, to.info, static_cast<png_uint_32>(image.width()),
                 static_cast<png_uint_32>(image.height()), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(to.png, to.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_filter(to.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP | PNG_FILTER_PAETH);
    png_set_compression_level(to.png, kLevel);
    png_set_compression_strategy(to.png, Z_DEFAULT_STRATEGY);  // faster here than that for filtered rows
    png_write_info(to.png, to.info);
    const auto& table = srgbByteFromPacked();
    Bytes row(3 * static_cast<std::size_t>(image.width()));
    for (int y = 0; y < image.height(); ++y) {
        unsigned char* byte = row.data();
        for (int x = 0; x < image.width(); ++x)
            for (const int shift : {0, 10, 20}) *byte++ = table[image.at(x, y) >> shift & 1023];
        png_write_row(to.png, row.data());
    }
    png_write_end(to.png, nullptr);
    return bytes;
}

}  // namespace stereonav
