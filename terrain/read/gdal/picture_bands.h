// The bands of a picture that are its colours, and the range of values that is shown.
#pragma once

#include <gdal_priv.h>

#include <array>
#include <filesystem>
#include <string>

#include "terrain/raster/ground_picture.h"

namespace stereonav {

struct PictureBands {
    enum class Kind { Gray, Rgb, Cmyk, Palette };
    Kind kind = Kind::Gray;
    // From 1: gray; or red, green, blue; or cyan, magenta, yellow, black.
    std::array<int, 4> numbers{1, 0, 0, 0};
    bool whiteIsLow = false;
    std::string guess;  // what was taken where the file does not say; else ""

    int count() const { return kind == Kind::Rgb ? 3 : kind == Kind::Cmyk ? 4 : 1; }
};

// Chooses the bands for the colours by their colour interpretation, else by their descriptions (red, B04),
// else takes the first three that are not alpha. Throws Error where the colours are in another form.
PictureBands pictureBandsOf(GDALDataset& dataset, const std::filesystem::path& file);

// Returns the range of the picture's bits. For 16 bits of which 98 % of the pixels use only the lower half,
// as for measured reflectance, returns the range between the 2nd and 98th percentile, from at most 512 x 512
// pixels. Throws Error where they can not be read.
PictureTone pictureToneOf(GDALDataset& dataset, const PictureBands& bands, const std::filesystem::path& file);

// Returns the range of the band's bits, without reading pixels.
PictureTone wholeToneOf(GDALRasterBand& band);

}  // namespace stereonav
