// Bands, units and missing values; see the header.
#include "terrain/read/gdal/height_band.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "terrain/read/height_limits.h"

namespace stereonav {
namespace {

constexpr const char* kGiveHeights =
    "give a GeoTIFF, .hgt, USGS DEM, ESRI ASCII or 16-bit PNG elevation model, or use this one as the image";
constexpr double kSurveyFoot = 1200.0 / 3937;

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

// Metres in the named unit of length, as GDAL's drivers and other programs write them.
std::optional<double> metresIn(std::string_view unit) {
    struct Unit {
        std::string_view name;
        double metres;
    };
    static constexpr Unit kUnits[] = {{"", 1},
                                      {"m", 1},
                                      {"metre", 1},
                                      {"meter", 1},
                                      {"metres", 1},
                                      {"meters", 1},
                                      {"ft", 0.3048},
                                      {"foot", 0.3048},
                                      {"feet", 0.3048},
                                      {"international foot", 0.3048},
                                      {"international feet", 0.3048},
                                      {"intl foot", 0.3048},
                                      {"us-ft", kSurveyFoot},
                                      {"us_ft", kSurveyFoot},
                                      {"us ft", kSurveyFoot},
                                      {"usft", kSurveyFoot},
                                      {"ftus", kSurveyFoot},
                                      {"us survey foot", kSurveyFoot},
                                      {"us survey feet", kSurveyFoot},
                                      {"u.s. survey foot", kSurveyFoot},
                                      {"u.s. survey feet", kSurveyFoot},
                                      {"us_survey_foot", kSurveyFoot},
                                      {"us_survey_feet", kSurveyFoot},
                                      {"foot_us", kSurveyFoot},
                                      {"survey foot", kSurveyFoot},
                                      {"yd", 0.9144},
                                      {"yard", 0.9144},
                                      {"fathom", 1.8288},
                                      {"dm", 0.1},
                                      {"decimetre", 0.1},
                                      {"decimeter", 0.1},
                                      {"cm", 0.01},
                                      {"centimetre", 0.01},
                                      {"centimeter", 0.01},
                                      {"mm", 0.001},
                                      {"millimetre", 0.001},
                                      {"millimeter", 0.001},
                                      {"km", 1000},
                                      {"kilometre", 1000},
                                      {"kilometer", 1000}};
    const std::string lower = lowerCase(unit);
    for (const Unit& u : kUnits)
        if (u.name == lower) return u.metres;
    return std::nullopt;
}

std::string unitOf(GDALRasterBand& band) {
    return band.GetUnitType() ? band.GetUnitType() : "";
}

// Whether a name speaks of heights, and not of their error.
bool speaksOfHeights(const std::string& text) {
    std::vector<std::string> words(1);
    for (const char c : lowerCase(text)) {
        if (std::isalpha(static_cast<unsigned char>(c)))
            words.back() += c;
        else
            words.emplace_back();
    }
    bool heights = false;
    for (const std::string& word : words) {
        for (const char* other :
             {"err", "uncert", "qual", "mask", "count", "slope", "aspect", "std", "sigma"})
            if (word.starts_with(other)) return false;
        for (const char* begin : {"elev", "height", "altitude", "topograph", "bathy"})
            heights |= word.starts_with(begin);
        for (const char* whole : {"dem", "dtm", "dsm", "hgt", "alt", "z"}) heights |= word == whole;
    }
    return heights;
}

// What it is called that speaks of heights; "" else.
std::string nameOfHeights(GDALRasterBand& band) {
    if (const char* text = band.GetDescription(); text && speaksOfHeights(text)) return text;
    for (const char* key : {"standard_name", "long_name", "NETCDF_VARNAME", "NAME", "DESCRIPTION"})
        if (const char* text = band.GetMetadataItem(key); text && speaksOfHeights(text)) return text;
    return "";
}

bool wholeNumbers(GDALRasterBand& band) {
    const GDALDataType type = band.GetRasterDataType();
    return type != GDT_Float32 && type != GDT_Float64;
}

[[noreturn]] void throwPicture(GDALDataset& dataset, const std::filesystem::path& file) {
    const int bands = dataset.GetRasterCount();
    throw Error(file.string(), "",
                fmt::format("expected one band of elevations, found a picture ({}, {} band{} of {})",
                            dataset.GetDriverName(), bands, bands == 1 ? "" : "s",
                            GDALGetDataTypeName(dataset.GetRasterBand(1)->GetRasterDataType())),
                kGiveHeights);
}

bool isAlphaOrPalette(GDALRasterBand& band) {
    const GDALColorInterp meaning = band.GetColorInterpretation();
    return meaning == GCI_AlphaBand || meaning == GCI_PaletteIndex || band.GetColorTable();
}

void chooseBand(GDALDataset& dataset, const std::filesystem::path& file, HeightBand& heights) {
    const int count = dataset.GetRasterCount();
    const auto choose = [&](int number, const std::string& why) {
        heights.number = number;
        heights.chosen = fmt::format("band {} of {}: {}", number, count, why);
    };
    if (std::string_view(dataset.GetDriverName()) == "JPEG") throwPicture(dataset, file);
    if (count > 1) {
        for (int k = 1; k <= count; ++k)
            if (const std::string name = nameOfHeights(*dataset.GetRasterBand(k)); !name.empty())
                return choose(k, "it is called \"" + name + "\"");
        int withUnit = 0, first = 0;
        for (int k = count; k >= 1; --k) {
            GDALRasterBand& band = *dataset.GetRasterBand(k);
            if (isAlphaOrPalette(band)) continue;
            first = k;
            if (const std::string unit = unitOf(band); !unit.empty() && metresIn(unit))
                withUnit = withUnit ? -1 : k;
        }
        if (withUnit > 0) return choose(withUnit, "it alone has a unit of length");
        if (first == 0 || (count >= 3 && wholeNumbers(*dataset.GetRasterBand(first))))
            throwPicture(dataset, file);
        choose(first, "the first; none is called heights");
    }
    if (dataset.GetRasterBand(heights.number)->GetColorTable()) throwPicture(dataset, file);
}

void readUnit(GDALDataset& dataset, GDALRasterBand& band, const std::filesystem::path& file,
              HeightBand& heights) {
    std::string unit = unitOf(band);
    auto metres = metresIn(unit);
    if (!metres)
        throw Error(file.string(), fmt::format("band {}", heights.number),
                    "expected heights in metres or feet, got the unit \"" + unit + "\"",
                    "convert the file to metres");
    const char* says = "by the band";
    const OGRSpatialReference* system = dataset.GetSpatialRef();
    if (!system) system = dataset.GetGCPSpatialRef();
    if (unit.empty() && system && system->IsCompound()) {
        const char* name = nullptr;
        metres = system->GetTargetLinearUnits("VERT_CS", &name);
        unit = name ? name : "";
        says = "by the vertical reference system";
    }
    if (*metres != 1) heights.unit = fmt::format("{}, {:.9g} m each, {}", unit, *metres, says);
    heights.scale = band.GetScale() * *metres;
    heights.offset = band.GetOffset() * *metres;
    if (band.GetScale() != 1 || band.GetOffset() != 0)
        heights.unit += fmt::format("{}stored times {:.9g} plus {:.9g}", heights.unit.empty() ? "" : "; ",
                                    band.GetScale(), band.GetOffset());
    if (!std::isfinite(heights.scale) || !std::isfinite(heights.offset) || heights.scale == 0)
        throw Error(file.string(), fmt::format("band {}", heights.number),
                    fmt::format("expected a scale other than 0 and an offset, got {:g} and {:g}",
                                band.GetScale(), band.GetOffset()),
                    "set them anew, for example with gdal_edit.py -scale 1 -offset 0");
}

std::optional<double> givenNodata(GDALRasterBand& band) {
    int has = 0;
    double value = 0;
    if (band.GetRasterDataType() == GDT_Int64)
        value = static_cast<double>(band.GetNoDataValueAsInt64(&has));
    else if (band.GetRasterDataType() == GDT_UInt64)
        value = static_cast<double>(band.GetNoDataValueAsUInt64(&has));
    else
        value = band.GetNoDataValue(&has);
    return has ? std::optional(value) : std::nullopt;
}

void readMissing(GDALDataset& dataset, GDALRasterBand& band, HeightBand& heights) {
    heights.nodata = givenNodata(band);
    heights.masked = (band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) == 0;
    heights.singlePrecision = band.GetRasterDataType() == GDT_Float32;
    if (heights.nodata) {
        heights.missing = fmt::format("{:.9g}", *heights.nodata);
    } else if (std::string_view(dataset.GetDriverName()) == "AAIGrid") {
        heights.nodata = -9999;
        heights.missing = "-9999, as the format has it";
    } else if (band.GetRasterDataType() == GDT_Int16) {
        heights.nodata = -32768;
        heights.missing = "-32768, as is customary: the file names none";
    }
    if (heights.masked) heights.missing += heights.missing.empty() ? "by a mask" : ", and by a mask";
}

}  // namespace

double HeightBand::metres(double stored) const {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    if (nodata &&
        (stored == *nodata || (singlePrecision && static_cast<float>(stored) == static_cast<float>(*nodata))))
        return kMissing;
    if (signedBytes && stored > 127) stored -= 256;
    if (nodata && stored == *nodata) return kMissing;
    const double height = stored * scale + offset;
    return std::abs(height) <= kMostHeight_m ? height : kMissing;
}

HeightBand heightBandOf(GDALDataset& dataset, const std::filesystem::path& file) {
    HeightBand heights;
    chooseBand(dataset, file, heights);
    GDALRasterBand& band = *dataset.GetRasterBand(heights.number);
    if (GDALDataTypeIsComplex(band.GetRasterDataType()))
        throw Error(file.string(), fmt::format("band {}", heights.number),
                    "expected real numbers, got complex ones", kGiveHeights);
    const char* pixels = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
    heights.signedBytes =
        band.GetRasterDataType() == GDT_Byte && pixels && std::string_view(pixels) == "SIGNEDBYTE";
    readUnit(dataset, band, file, heights);
    readMissing(dataset, band, heights);
    return heights;
}

}  // namespace stereonav
