// The band of a raster that holds the heights, and the meaning of its numbers.
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
    std::string unit;              // "" for plain metres, else the unit and its source

    std::optional<double> nodata;  // stored
    std::string missing;           // what marks missing samples, in words
    bool singlePrecision = false;  // stored as float: nodata is compared after rounding
    bool signedBytes = false;      // bytes above 127 are below 0 (GDAL's PIXELTYPE=SIGNEDBYTE)
    bool masked = false;           // a mask or an alpha band marks the missing samples

    // Returns metres; NaN where missing.
    double metres(double stored) const;
};

// The error for a raster whose numbers are not heights.
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

// Returns the band of heights. Of several bands it is the one whose description or names are about heights;
// else the only one with a unit of length; else the first. Rasters with a colour table, or with three or more
// bands of whole numbers without such names, are pictures. Heights are in the band's unit, else in that of
// the vertical reference system, else in metres; where band or system count downward they change their sign.
// Throws Error that names `file`, such as NoHeights.
HeightBand heightBandOf(GDALDataset& dataset, const std::filesystem::path& file);

}  // namespace stereonav
