// Colours through GDAL: bytes or 16-bit numbers, gray, RGB or palette, with masks and alpha.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/raster_file.h"

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

// Reads the window, averaged down by the factor `shrink` (>= 1) each way. Throws Error.
GroundPicture readPicture(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                          const PixelWindow& window, const glm::dvec2& shrink) {
    checkIsPicture(dataset, file);
    GroundPicture::Parts parts;
    const int sourceWidth = window.xMax - window.xMin, sourceHeight = window.yMax - window.yMin;
    const int width = std::max(1, static_cast<int>(sourceWidth / shrink.x + 0.5));
    const int height = std::max(1, static_cast<int>(sourceHeight / shrink.y + 0.5));
    checkRasterSize(file, width, height);
    parts.origin = {window.xMin, window.yMin};
    parts.shrink = glm::dvec2(sourceWidth, sourceHeight) / glm::dvec2(width, height);
    parts.color.resize(width, height);
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
                    parts.color.at(x, y) = paletteColor(*palette, static_cast<int>(word));
                else
                    parts.color.at(x, y) |= color ? code << 10 * channel : code | code << 10 | code << 20;
            }
    }
    if (!masked) return GroundPicture(std::move(parts));
    std::vector<unsigned char> mask(static_cast<std::size_t>(width) * height);
    if (!reader.bytes(*first.GetMaskBand(), mask.data())) fail();
    parts.mask.resize(width, height);
    for (int y = 0; y < height; ++y)
        std::copy_n(&mask[static_cast<std::size_t>(y) * width], width, parts.mask.row(y));
    return GroundPicture(std::move(parts));
}

class GdalPicture final : public RasterPicture {
public:
    GdalPicture(const std::filesystem::path& file, const std::string& expected, const std::string& advice)
        : mFile(file), mDataset(openRaster(file, mMessages, expected, advice)) {}

    Georeference georeference(bool& known) override { return georeferenceOf(*mDataset, mFile, known); }
    GroundPicture read(const PixelWindow& window, const glm::dvec2& shrink) override {
        return readPicture(*mDataset, mMessages, mFile, window, shrink);
    }

private:
    std::filesystem::path mFile;
    GdalMessages mMessages;
    GdalDataset mDataset;
};

}  // namespace

std::unique_ptr<RasterPicture> openRasterPicture(const std::filesystem::path& file,
                                                 const std::string& expected, const std::string& advice) {
    return std::make_unique<GdalPicture>(file, expected, advice);
}

}  // namespace stereonav
