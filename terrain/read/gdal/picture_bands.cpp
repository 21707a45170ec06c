#include "terrain/read/gdal/picture_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "engine/base/error.h"

namespace stereonav {
namespace {

int bandMeaning(GDALDataset& dataset, GDALColorInterp meaning) {
    for (int k = 1; k <= dataset.GetRasterCount(); ++k)
        if (dataset.GetRasterBand(k)->GetColorInterpretation() == meaning) return k;
    return 0;
}

// Words of a description in small letters: "Band 4 - Red" -> band, 4, red.
std::vector<std::string> wordsOfBand(GDALRasterBand& band) {
    std::vector<std::string> words(1);
    for (const char c : std::string_view(band.GetDescription()))
        if (std::isalnum(static_cast<unsigned char>(c)))
            words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else
            words.emplace_back();
    return words;
}

// The only band whose description has the word, or Sentinel-2's number of that colour, and does not speak of
// what lies beside it ("red edge").
int bandCalled(GDALDataset& dataset, std::string_view color, std::string_view number) {
    int found = 0;
    for (int k = 1; k <= dataset.GetRasterCount(); ++k) {
        const std::vector<std::string> words = wordsOfBand(*dataset.GetRasterBand(k));
        const auto has = [&](std::string_view word) {
            return std::find(words.begin(), words.end(), word) != words.end();
        };
        if ((!has(color) && !has(number)) || has("edge") || has("near") || has("infra")) continue;
        if (found != 0) return 0;
        found = k;
    }
    return found;
}

bool isAlpha(GDALRasterBand& band) {
    return band.GetColorInterpretation() == GCI_AlphaBand;
}

// Returns the bands, without those of alpha.
std::vector<int> colorBands(GDALDataset& dataset) {
    std::vector<int> bands;
    for (int k = 1; k <= dataset.GetRasterCount(); ++k)
        if (!isAlpha(*dataset.GetRasterBand(k))) bands.push_back(k);
    return bands;
}

bool takeNamed(GDALDataset& dataset, PictureBands& bands) {
    const int red = bandMeaning(dataset, GCI_RedBand), green = bandMeaning(dataset, GCI_GreenBand),
              blue = bandMeaning(dataset, GCI_BlueBand);
    const int cyan = bandMeaning(dataset, GCI_CyanBand), magenta = bandMeaning(dataset, GCI_MagentaBand),
              yellow = bandMeaning(dataset, GCI_YellowBand), black = bandMeaning(dataset, GCI_BlackBand);
    const int calledRed = bandCalled(dataset, "red", "b04"),
              calledGreen = bandCalled(dataset, "green", "b03"),
              calledBlue = bandCalled(dataset, "blue", "b02");
    if (red && green && blue)
        bands.kind = PictureBands::Kind::Rgb, bands.numbers = {red, green, blue, 0};
    else if (cyan && magenta && yellow && black)
        bands.kind = PictureBands::Kind::Cmyk, bands.numbers = {cyan, magenta, yellow, black};
    else if (calledRed && calledGreen && calledBlue)
        bands.kind = PictureBands::Kind::Rgb, bands.numbers = {calledRed, calledGreen, calledBlue, 0};
    else
        return false;
    return true;
}

void refuseOtherColors(GDALDataset& dataset, const std::filesystem::path& file) {
    for (const GDALColorInterp other : {GCI_HueBand, GCI_SaturationBand, GCI_YCbCr_CbBand, GCI_YCbCr_CrBand})
        if (bandMeaning(dataset, other))
            throw Error(file.string(), "",
                        fmt::format("expected red, green and blue bands, found {}",
                                    GDALGetColorInterpretationName(other)),
                        "convert it to RGB");
}

// How many bits of a sample count.
int bitsOf(GDALRasterBand& band) {
    const int all = GDALGetDataTypeSizeBits(band.GetRasterDataType());
    const char* const said = band.GetMetadataItem("NBITS", "IMAGE_STRUCTURE");
    const int bits = said ? std::atoi(said) : all;
    return bits >= 1 && bits <= all ? bits : all;
}

// Values of a band, thinned; without what is masked.
void addSome(GDALDataset& dataset, int number, const std::filesystem::path& file,
             std::vector<double>& values) {
    constexpr int kSide = 512;
    const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize(),
              columns = std::min(width, kSide), rows = std::min(height, kSide);
    const auto count = static_cast<std::size_t>(columns) * rows;
    std::vector<float> some(count);
    std::vector<unsigned char> mask(count, 255);
    GDALRasterBand& band = *dataset.GetRasterBand(number);
    const auto read = [&](GDALRasterBand& from, void* out, GDALDataType type) {
        return from.RasterIO(GF_Read, 0, 0, width, height, out, columns, rows, type, 0, 0, nullptr) ==
               CE_None;
    };
    const bool masked = (band.GetMaskFlags() & GMF_ALL_VALID) == 0;
    if (!read(band, some.data(), GDT_Float32) ||
        (masked && !read(*band.GetMaskBand(), mask.data(), GDT_Byte)))
        throw Error(file.string(), "", "the picture is cut off or damaged", "fetch or export the file again");
    for (std::size_t n = 0; n < count; ++n)
        if (mask[n] != 0) values.push_back(some[n]);
}

}  // namespace

PictureBands pictureBandsOf(GDALDataset& dataset, const std::filesystem::path& file) {
    PictureBands bands;
    GDALRasterBand& first = *dataset.GetRasterBand(1);
    const char* const low = first.GetMetadataItem("MINISWHITE", "IMAGE_STRUCTURE");
    const char* const ofFile = dataset.GetMetadataItem("MINISWHITE", "IMAGE_STRUCTURE");
    if (first.GetColorTable()) {
        bands.kind = PictureBands::Kind::Palette;
        return bands;
    }
    if (takeNamed(dataset, bands)) return bands;
    refuseOtherColors(dataset, file);
    const std::vector<int> colors = colorBands(dataset);
    if (colors.size() < 3) {
        bands.numbers[0] = colors.empty() ? 1 : colors.front();
        bands.whiteIsLow = (low && EQUAL(low, "YES")) || (ofFile && EQUAL(ofFile, "YES"));
        return bands;
    }
    bands.kind = PictureBands::Kind::Rgb;
    bands.numbers = {colors[0], colors[1], colors[2], 0};
    bands.guess =
        fmt::format("does not say which of its {} bands are red, green and blue: {}, {} and {} are taken",
                    dataset.GetRasterCount(), colors[0], colors[1], colors[2]);
    return bands;
}

PictureTone wholeToneOf(GDALRasterBand& band) {
    const bool isSigned = band.GetRasterDataType() == GDT_Int16;
    return {0, std::ldexp(1.0, bitsOf(band) - (isSigned ? 1 : 0)) - 1, {}};
}

PictureTone pictureToneOf(GDALDataset& dataset, const PictureBands& bands,
                          const std::filesystem::path& file) {
    GDALRasterBand& first = *dataset.GetRasterBand(bands.numbers[0]);
    PictureTone tone = wholeToneOf(first);
    const std::string name = file.filename().string();
    if (!bands.guess.empty()) tone.notes.push_back(name + " " + bands.guess);
    const bool stretched = bands.kind == PictureBands::Kind::Gray || bands.kind == PictureBands::Kind::Rgb;
    if (!stretched || first.GetRasterDataType() == GDT_Byte) return tone;
    std::vector<double> values;
    for (int n = 0; n < bands.count(); ++n) addSome(dataset, bands.numbers[n], file, values);
    if (values.empty()) return tone;
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * double(values.size() - 1))];
    };
    constexpr double kDark = 0.5;
    if (at(0.98) >= kDark * tone.white) return tone;
    tone.black = std::max(0.0, at(0.02)), tone.white = at(0.98);
    if (!(tone.white > tone.black)) tone.black = 0, tone.white = std::max(1.0, tone.white);
    tone.notes.push_back(
        fmt::format("{} is shown from {:g} (black) to {:g} (white), where 2 and 98 % of its values lie: "
                    "it uses little of its 16 bits",
                    name, tone.black, tone.white));
    return tone;
}

}  // namespace stereonav
