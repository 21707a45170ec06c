// Which band of a raster holds the heights, and what its numbers mean.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/error.h"

namespace stereonav {

// Turns stored numbers into metres.
struct HeightBand {
    int number = 1;      // number of the band, from 1
    std::string chosen;  // "band 2 of 3: its description is \"elevation\""; "" where there is only one

    double scale = 1, offset = 0;  // metres = stored * scale + offset
    std::string unit;              // "" for metres that need no word, else which unit and who says so

    std::optional<double> nodata;  // stored
    std::string missing;           // what marks missing samples, in words
    bool singlePrecision = false;  // stored as float: nodata is compared after rounding
    bool signedBytes = false;      // bytes above 127 are below 0 (GDAL's PIXELTYPE=SIGNEDBYTE)
    bool masked = false;           // a mask or an alpha band says which samples there are

    // Metres; NaN where missing.
    double metres(double stored) const;
};

// A raster whose numbers are something else than heights.
class NoHeights : public Error {
public:
    // why: "a picture", "its unit is \"degree\"".
    NoHeights(const std::filesystem::path& file, const std::string& place, const std::string& problem,
              const std::string& advice, std::string why)
        : Error(file.string(), place, problem, advice), mWhy(std::move(why)) {}
    const std::string& why() const { return mWhy; }

private:
    std::string mWhy;
};

// The band of heights. Of several it is the one whose description or names speak of heights; else the only
// one with a unit of length; else the first. A colour table, or three bands and more of whole numbers without
// such a word, are a picture. Heights are in the band's unit, else in that of the vertical reference system,
// else in metres; where band or system count downward they are turned over. Throws Error that names `file`,
// NoHeights among them.
HeightBand heightBandOf(GDALDataset& dataset, const std::filesystem::path& file);

}  // namespace stereonav
