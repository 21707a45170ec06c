// Colours through GDAL: bytes or 16-bit numbers, gray, RGB or palette, with masks and alpha.
#include "terrain/ground_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using Words = std::vector<std::uint16_t>;

// Reads bands of one window into a buffer of another size, averaging.
class WindowReader {
public:
    WindowReader(GDALDataset& dataset, const PixelWindow& window, int width, int height)
        : mDataset(dataset), mWindow(window), mWidth(width), mHeight(height) {}

    Words words(GDALRasterBand& band, bool average) const {
        Words out(static_cast<std::size_t>(mWidth) * mHeight);
        return read(band, out.data(), GDT_UInt16, average) ? out : Words();
    }

    bool bytes(GDALRasterBand& band, void* out) const { return read(band, out, GDT_Byte, false); }

private:
    bool read(GDALRasterBand& band, void* out, GDALDataType type, bool average) const {
        GDALRasterIOExtraArg extra;
        INIT_RASTERIO_EXTRA_ARG(extra);
        extra.eResampleAlg = average ? GRIORA_Average : GRIORA_NearestNeighbour;
        return band.RasterIO(GF_Read, mWindow.xMin, mWindow.yMin, mWindow.xMax - mWindow.xMin,
                             mWindow.yMax - mWindow.yMin, out, mWidth, mHeight, type, 0, 0,
                             &extra) == CE_None;
    }

    GDALDataset& mDataset;
    PixelWindow mWindow;
    int mWidth, mHeight;
};

void checkIsPicture(GDALDataset& dataset, const std::filesystem::path& file) {
    const GDALDataType type = dataset.GetRasterBand(1)->GetRasterDataType();
    if (type == GDT_Byte || type == GDT_UInt16) return;
    throw Error(
        file.string(), "",
        fmt::format("expected a picture of 8 or 16 bits, found {} samples", GDALGetDataTypeName(type)),
        "give a JPEG, PNG or TIFF picture of the ground");
}

PackedColor paletteColor(const GDALColorTable& table, int index) {
    const GDALColorEntry* entry = table.GetColorEntry(index);
    if (!entry) return 0;
    const auto& packed = packedFromSrgbByte();
    return static_cast<PackedColor>(packed[entry->c1 & 255] | packed[entry->c2 & 255] << 10 |
                                    packed[entry->c3 & 255] << 20);
}

}  // namespace

GroundPicture::GroundPicture(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                             const PixelWindow& window, const glm::dvec2& shrink) {
    checkIsPicture(dataset, file);
    const int sourceWidth = window.xMax - window.xMin, sourceHeight = window.yMax - window.yMin;
    const int width = std::max(1, static_cast<int>(sourceWidth / shrink.x + 0.5));
    const int height = std::max(1, static_cast<int>(sourceHeight / shrink.y + 0.5));
    checkRasterSize(file, width, height);
    mOrigin = {window.xMin, window.yMin};
    mShrink = glm::dvec2(sourceWidth, sourceHeight) / glm::dvec2(width, height);
    mColor.resize(width, height);
    const WindowReader reader(dataset, window, width, height);
    const auto fail = [&] {
        throw Error(file.string(), "", "the picture is cut off or damaged" + messages.reason(file),
                    "fetch or export the file again");
    };
    GDALRasterBand& first = *dataset.GetRasterBand(1);
    const GDALColorTable* palette = first.GetColorTable();
    const bool masked = !(first.GetMaskFlags() & GMF_ALL_VALID);
    messages.clear();  // from here on only what goes wrong with the pixels counts
    const bool bytes = first.GetRasterDataType() == GDT_Byte,
               color = !palette && dataset.GetRasterCount() >= 3;
    const auto& packed = packedFromSrgbByte();
    for (int channel = 0; channel < 3; ++channel) {
        if (channel > 0 && !color) break;
        const Words words = reader.words(*dataset.GetRasterBand(channel + 1), !palette);
        if (words.empty() || messages.hasError()) fail();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const std::uint32_t word = words[static_cast<std::size_t>(y) * width + x];
                const std::uint32_t code =
                    packed[std::min(255u, bytes ? word : (word * 255u + 32767u) / 65535u)];
                if (palette)
                    mColor.at(x, y) = paletteColor(*palette, static_cast<int>(word));
                else
                    mColor.at(x, y) |= color ? code << 10 * channel : code | code << 10 | code << 20;
            }
    }
    if (!masked) return;
    std::vector<unsigned char> mask(static_cast<std::size_t>(width) * height);
    if (!reader.bytes(*first.GetMaskBand(), mask.data())) fail();
    mMask.resize(width, height);
    for (int y = 0; y < height; ++y)
        std::copy_n(&mask[static_cast<std::size_t>(y) * width], width, mMask.row(y));
}

GroundPicture::Sample GroundPicture::at(const glm::dvec2& pixel) const {
    const glm::dvec2 p = (pixel - mOrigin) / mShrink;
    Sample sample;
    // A hair of slack: edges that coincide must not lose their last texel to rounding.
    if (!(p.x >= -0.01 && p.y >= -0.01 && p.x <= mColor.width() + 0.01 && p.y <= mColor.height() + 0.01))
        return sample;
    const double x = std::clamp(p.x - 0.5, 0.0, mColor.width() - 1.0);
    const double y = std::clamp(p.y - 0.5, 0.0, mColor.height() - 1.0);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a) {
            const float weight = (a ? u : 1 - u) * (b ? v : 1 - v);
            const int cx = std::min(i + a, mColor.width() - 1), cy = std::min(j + b, mColor.height() - 1);
            if (!mMask.empty() && mMask.at(cx, cy) == 0) continue;
            sample.color += weight * unpackColor(mColor.at(cx, cy));
            sample.cover += weight;
        }
    if (sample.cover > 0) sample.color /= sample.cover;
    return sample;
}

}  // namespace stereonav
