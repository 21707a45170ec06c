// A raster as the library itself reads and places it: what our reader is held against.
#pragma once

#include <gdal_alg.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "terrain/read/dem_reader.h"

namespace stereonav::test {

inline DemGrid readGround(const std::filesystem::path& file) {
    Progress progress;
    return readDem(file, 1, progress);
}

class GdalReading {
public:
    // wkt: the system of the places that pixelOf() takes; "" for the file's own.
    GdalReading(const std::filesystem::path& file, int band, const std::string& wkt) {
        GDALAllRegister();
        mDataset.reset(GDALDataset::Open(file.string().c_str()));
        EXPECT_NE(mDataset, nullptr) << file;
        width = mDataset->GetRasterXSize();
        height = mDataset->GetRasterYSize();
        readValues(*mDataset->GetRasterBand(band));
        const std::string target = "DST_SRS=" + wkt;
        const char* const options[] = {wkt.empty() ? nullptr : target.c_str(), nullptr};
        double none[6];
        if (mDataset->GetGeoTransform(none) == CE_None || mDataset->GetGCPCount() > 0)
            mPlaces.reset(
                GDALCreateGenImgProjTransformer2(mDataset.get(), nullptr, const_cast<char**>(options)));
    }

    // Returns a sample not scaled by the band's scale and offset, NaN where its mask says so.
    double at(int column, int row) const { return mValues[static_cast<std::size_t>(row) * width + column]; }

    // (0.5, 0.5) is the centre of the first pixel.
    glm::dvec2 pixelOf(glm::dvec2 place) const {
        if (!mPlaces) return {place.x, -place.y};
        double z = 0;
        int known = 0;
        EXPECT_TRUE(GDALGenImgProjTransform(mPlaces.get(), TRUE, 1, &place.x, &place.y, &z, &known));
        return known ? place : glm::dvec2(std::numeric_limits<double>::infinity());
    }

    int width = 0, height = 0;

private:
    void readValues(GDALRasterBand& band) {
        const std::size_t count = static_cast<std::size_t>(width) * height;
        std::vector<unsigned char> mask(count);
        mValues.resize(count);
        EXPECT_EQ(band.RasterIO(GF_Read, 0, 0, width, height, mValues.data(), width, height, GDT_Float64, 0,
                                0, nullptr),
                  CE_None);
        EXPECT_EQ(band.GetMaskBand()->RasterIO(GF_Read, 0, 0, width, height, mask.data(), width, height,
                                               GDT_Byte, 0, 0, nullptr),
                  CE_None);
        for (std::size_t k = 0; k < count; ++k)
            mValues[k] = mask[k] ? mValues[k] * band.GetScale() + band.GetOffset() : NAN;
    }

    struct Close {
        void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
    };
    struct Destroy {
        void operator()(void* places) const { GDALDestroyGenImgProjTransformer(places); }
    };
    std::unique_ptr<GDALDataset, Close> mDataset;
    std::unique_ptr<void, Destroy> mPlaces;
    std::vector<double> mValues;
};

struct Compared {
    int exact = 0;    // samples that stand where one of the file's stands, to 1e-3 of a pixel
    int between = 0;  // others
    int missing = 0;  // in both
    int outside = 0;  // beyond the file
    int wrong = 0;
    std::string first;  // first of the wrong ones
};

// Every sample of the grid with what the library reads at its place: the same float where it is a sample of
// the file, within the range of the four around else, missing where the nearest is missing. metres: of the
// library's values.
inline Compared compareWithGdal(const DemGrid& dem, const GdalReading& truth, double metres = 1) {
    Compared result;
    const auto wrong = [&](int i, int j, const glm::dvec2& p, double got, double expected) {
        if (result.wrong++ == 0)
            result.first = "sample " + std::to_string(i) + "," + std::to_string(j) + " at pixel " +
                           std::to_string(p.x) + "," + std::to_string(p.y) + " is " + std::to_string(got) +
                           ", expected " + std::to_string(expected);
    };
    for (int j = 0; j < dem.height; ++j)
        for (int i = 0; i < dem.width; ++i) {
            const double got = dem.heights[static_cast<std::size_t>(j) * dem.width + i];
            const glm::dvec2 p = truth.pixelOf(dem.grid.fromPixel({i + 0.5, dem.height - 1 - j + 0.5})) - 0.5;
            const double c = std::floor(p.x + 0.5), r = std::floor(p.y + 0.5);
            const double off = std::max(std::abs(p.x - c), std::abs(p.y - r));
            if (!(c >= 0 && r >= 0 && c < truth.width && r < truth.height)) {
                ++result.outside;
                if (!std::isnan(got) && off < 0.45) wrong(i, j, p, got, NAN);
                continue;
            }
            const double nearest = metres * truth.at(static_cast<int>(c), static_cast<int>(r));
            if (std::isnan(nearest) || std::isnan(got)) {
                ++result.missing;
                if (std::isnan(nearest) != std::isnan(got) && off < 0.45) wrong(i, j, p, got, nearest);
            } else if (off < 1e-3) {
                ++result.exact;
                if (!(std::abs(got - nearest) <= 1e-7 * std::abs(nearest) + 1e-30 + off * 10))
                    wrong(i, j, p, got, nearest);
            } else {
                ++result.between;
                double low = nearest, high = nearest;
                constexpr double kSlack = 0.02;  // pixels: steps of our maps between rasters
                for (const double y : {p.y - kSlack, p.y + kSlack})
                    for (const double x : {p.x - kSlack, p.x + kSlack})
                        for (int k = 0; k < 4; ++k) {
                            const int a =
                                std::clamp(static_cast<int>(std::floor(x)) + k % 2, 0, truth.width - 1);
                            const int b =
                                std::clamp(static_cast<int>(std::floor(y)) + k / 2, 0, truth.height - 1);
                            const double h = metres * truth.at(a, b);
                            if (!std::isnan(h)) low = std::min(low, h), high = std::max(high, h);
                        }
                const double slack = 1e-6 * (std::abs(low) + std::abs(high));
                if (!(got >= low - slack && got <= high + slack)) wrong(i, j, p, got, nearest);
            }
        }
    return result;
}

}  // namespace stereonav::test
