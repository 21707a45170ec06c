// Colours through GDAL: bytes or 16-bit numbers, gray, RGB, CMYK or palette, with masks and alpha.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/picture_bands.h"
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
    if (type == GDT_Byte || type == GDT_UInt16 || type == GDT_Int16) return;
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

// Codes of sRGB, 0 to 255, of stored values.
class ToneCodes {
public:
    ToneCodes(const PictureTone& tone, bool whiteIsLow)
        : mBlack(tone.black), mScale(255 / std::max(1.0, tone.white - tone.black)), mWhiteIsLow(whiteIsLow) {}
    int operator()(std::uint16_t stored) const {
        const int code = std::clamp(static_cast<int>((stored - mBlack) * mScale + 0.5), 0, 255);
        return mWhiteIsLow ? 255 - code : code;
    }

private:
    double mBlack, mScale;
    bool mWhiteIsLow;
};

// One colour of planes of codes; inks take light away.
PackedColor packedOf(const std::array<Words, 4>& planes, const PictureBands& bands, const ToneCodes& codes,
                     std::size_t pixel) {
    const auto& packed = packedFromSrgbByte();
    const auto code = [&](int plane) { return codes(planes[plane][pixel]); };
    if (bands.kind == PictureBands::Kind::Gray) {
        const PackedColor gray = packed[code(0)];
        return static_cast<PackedColor>(gray | gray << 10 | gray << 20);
    }
    const auto channel = [&](int plane) {
        if (bands.kind == PictureBands::Kind::Rgb) return code(plane);
        return (255 - code(plane)) * (255 - code(3)) / 255;
    };
    return static_cast<PackedColor>(packed[channel(0)] | packed[channel(1)] << 10 | packed[channel(2)] << 20);
}

// Reads the window, averaged down by the factor `shrink` (>= 1) each way. Throws Error.
GroundPicture readPicture(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                          const PixelWindow& window, const glm::dvec2& shrink, const PictureTone& tone) {
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
        messages.throwIfRefused(file);
        throw Error(file.string(), "", "the picture is cut off or damaged" + messages.reason(file),
                    "fetch or export the file again");
    };
    const PictureBands bands = pictureBandsOf(dataset, file);
    GDALRasterBand& first = *dataset.GetRasterBand(bands.numbers[0]);
    const GDALColorTable* palette = first.GetColorTable();
    const bool masked = !(first.GetMaskFlags() & GMF_ALL_VALID);
    messages.clear();  // from here on only what goes wrong with the pixels counts
    std::array<Words, 4> planes;
    for (int n = 0; n < bands.count(); ++n) {
        planes[n] = reader.words(*dataset.GetRasterBand(bands.numbers[n]), !palette);
        if (planes[n].empty() || messages.hasError()) fail();
    }
    const ToneCodes codes(tone, bands.whiteIsLow);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel = static_cast<std::size_t>(y) * width + x;
            parts.color.at(x, y) = palette ? paletteColor(*palette, static_cast<int>(planes[0][pixel]))
                                           : packedOf(planes, bands, codes, pixel);
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
        : mFile(file), mDataset(openRaster(file, mMessages, expected, advice, &mNotes)) {}

    Georeference georeference(bool& known) override { return georeferenceOf(*mDataset, mFile, known); }
    PictureTone tone() override {
        checkIsPicture(*mDataset, mFile);
        PictureTone tone = pictureToneOf(*mDataset, pictureBandsOf(*mDataset, mFile), mFile);
        tone.notes.insert(tone.notes.begin(), mNotes.begin(), mNotes.end());
        return tone;
    }
    PictureTone wholeTone() override { return wholeToneOf(*mDataset->GetRasterBand(1)); }
    GroundPicture read(const PixelWindow& window, const glm::dvec2& shrink,
                       const PictureTone& tone) override {
        return readPicture(*mDataset, mMessages, mFile, window, shrink, tone);
    }

private:
    std::filesystem::path mFile;
    GdalMessages mMessages;
    std::vector<std::string> mNotes;
    GdalDataset mDataset;
};

}  // namespace

std::unique_ptr<RasterPicture> openRasterPicture(const std::filesystem::path& file,
                                                 const std::string& expected, const std::string& advice) {
    return std::make_unique<GdalPicture>(file, expected, advice);
}

}  // namespace stereonav
