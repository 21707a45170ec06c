// Which bands of a picture are its colours, and from which value to which they go.
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
    std::array<int, 4> numbers{1, 0, 0, 0};  // from 1: the gray, red green blue, or cyan magenta yellow black
    bool whiteIsLow = false;
    std::string guess;  // where the file does not say which are which, what was taken; "" else

    int count() const { return kind == Kind::Rgb ? 3 : kind == Kind::Cmyk ? 4 : 1; }
};

// Chooses the bands of colour by their colour interpretation, else by their descriptions (red, B04), else
// takes the first three that are no alpha. Throws Error for colours that are none of these.
PictureBands pictureBandsOf(GDALDataset& dataset, const std::filesystem::path& file);

// All that its bits hold; where 98 % of the pixels of 16 bits lie in the lower half of that, as measured
// reflectance does, what 2 to 98 % lie between, by 512 x 512 pixels at most. Throws Error where they can not
// be read.
PictureTone pictureToneOf(GDALDataset& dataset, const PictureBands& bands, const std::filesystem::path& file);

// Returns the range that its bits hold, whatever the pixels.
PictureTone wholeToneOf(GDALRasterBand& band);

}  // namespace stereonav
