// Bands, units and missing values; see the header.
#include "terrain/read/gdal/height_band.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "engine/base/error.h"
#include "terrain/read/gdal/height_unit.h"
#include "terrain/read/gdal/raster_words.h"
#include "terrain/read/height_limits.h"

namespace stereonav {
namespace {

constexpr const char* kGiveHeights =
    "give a GeoTIFF, .hgt, USGS DEM, ESRI ASCII or 16-bit PNG elevation model, or use this one as the image";

std::string unitOf(GDALRasterBand& band) {
    return band.GetUnitType() ? band.GetUnitType() : "";
}

// Returns the band's description or name, if its words are about heights; "" where none is.
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
    throw NoHeights(file, "",
                    fmt::format("expected one band of elevations, found a picture ({}, {} band{} of {})",
                                dataset.GetDriverName(), bands, bands == 1 ? "" : "s",
                                GDALGetDataTypeName(dataset.GetRasterBand(1)->GetRasterDataType())),
                    kGiveHeights, "a picture");
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
            if (const std::string unit = unitOf(band); !unit.empty() && heightUnitOf(unit))
                withUnit = withUnit ? -1 : k;
        }
        if (withUnit > 0) return choose(withUnit, "it alone has a unit of length");
        if (first == 0 || (count >= 3 && wholeNumbers(*dataset.GetRasterBand(first))))
            throwPicture(dataset, file);
        choose(first, "the first; none is called heights");
    }
    if (dataset.GetRasterBand(heights.number)->GetColorTable()) throwPicture(dataset, file);
}

// The axis along which heights are counted, of a reference system that has one.
struct HeightAxis {
    bool down = false;
    double metres = 1;
    std::string unit;  // name of the unit
};

// Returns the last axis of a reference system that points up or down: compound systems, systems of three axes
// and vertical ones have such an axis.
std::optional<HeightAxis> heightAxisOf(const OGRSpatialReference& system) {
    for (int n = system.GetAxesCount() - 1; n >= 0; --n) {
        OGRAxisOrientation way = OAO_Other;
        double metres = 1;
        system.GetAxis(nullptr, n, &way, &metres);
        if (way != OAO_Up && way != OAO_Down) continue;
        HeightAxis axis{way == OAO_Down, metres, ""};
        const char* name = nullptr;
        if (system.IsCompound() || system.IsVertical())
            axis.metres = system.GetTargetLinearUnits("VERT_CS", &name);
        axis.unit = name ? name : "its own";
        return axis;
    }
    return std::nullopt;
}

// Returns true where the band's metadata say, in the words of the CF conventions, that it holds depths.
bool bandCountsDown(GDALRasterBand& band) {
    const char* const positive = band.GetMetadataItem("positive");
    if (positive) return EQUAL(positive, "down");
    const char* const name = band.GetMetadataItem("standard_name");
    return name && std::string_view(name).find("depth_below") != std::string_view::npos;
}

void readUnit(GDALDataset& dataset, GDALRasterBand& band, const std::filesystem::path& file,
              HeightBand& heights) {
    std::string unit = unitOf(band);
    const std::optional<HeightUnit> named = heightUnitOf(unit);
    if (!named)
        throw NoHeights(file, fmt::format("band {}", heights.number),
                        "expected heights in metres or feet, got the unit \"" + unit + "\"",
                        "convert the file to metres", "its unit is \"" + unit + "\"");
    double metres = named->metres;
    const char *says = "by the band", *down = nullptr;
    const OGRSpatialReference* system = dataset.GetSpatialRef();
    if (!system) system = dataset.GetGCPSpatialRef();
    const std::optional<HeightAxis> axis = system ? heightAxisOf(*system) : std::nullopt;
    if (unit.empty() && axis)
        metres = axis->metres, unit = axis->unit, says = "by the vertical reference system";
    if (axis && axis->down) down = "by the vertical reference system";
    if (named->down || bandCountsDown(band)) down = "by the band";
    const auto add = [&](const std::string& words) {
        heights.unit += (heights.unit.empty() ? "" : "; ") + words;
    };
    if (metres != 1) add(fmt::format("{}, {:.9g} m each, {}", unit, metres, says));
    if (down) add(fmt::format("depths, counted downward {}", down));
    if (down) metres = -metres;
    heights.scale = band.GetScale() * metres;
    heights.offset = band.GetOffset() * metres;
    if (band.GetScale() != 1 || band.GetOffset() != 0)
        add(fmt::format("stored times {:.9g} plus {:.9g}", band.GetScale(), band.GetOffset()));
    if (!std::isfinite(heights.scale) || !std::isfinite(heights.offset) || heights.scale == 0)
        throw Error(file.string(), fmt::format("band {}", heights.number),
                    fmt::format("expected a scale other than 0 and an offset, got {:g} and {:g}",
                                band.GetScale(), band.GetOffset()),
                    "set them again, for example with gdal_edit.py -scale 1 -offset 0");
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
        heights.missing = "-32768, by convention: the file names none";
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
        throw NoHeights(file, fmt::format("band {}", heights.number),
                        "expected real numbers, got complex ones", kGiveHeights, "complex numbers");
    const char* pixels = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
    heights.signedBytes =
        band.GetRasterDataType() == GDT_Byte && pixels && std::string_view(pixels) == "SIGNEDBYTE";
    readUnit(dataset, band, file, heights);
    readMissing(dataset, band, heights);
    return heights;
}

}  // namespace stereonav
