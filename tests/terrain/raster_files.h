// Small raster files for tests, written through GDAL or as text into a folder that goes away.
#pragma once

#include <cpl_error.h>
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/error.h"

namespace stereonav::test {

// What one line of message is held against.
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class TempFolder {
public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "stereonav-test-XXXXXX").string();
        mPath = mkdtemp(name.data());
    }
    ~TempFolder() {
        std::error_code code;
        std::filesystem::remove_all(mPath, code);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return mPath / name; }

    std::filesystem::path text(const std::string& name, const std::string& content) const {
        std::ofstream(mPath / name, std::ios::binary) << content;
        return mPath / name;
    }

private:
    std::filesystem::path mPath;
};

struct RasterSpec {
    const char* driver = "GTiff";
    GDALDataType type = GDT_Float32;
    int width = 0, height = 0, bands = 1;
    int epsg = 32633;  // 0: none
    std::array<double, 6> transform{500000, 30, 0, 5000000, 0, -30};
    bool placed = true;  // whether the transform is written
    std::vector<std::pair<const char*, std::string>> metadata;
    const char* unit = nullptr;
    bool hasNodata = false;
    double nodata = 0;
    const char* linearUnit = nullptr;  // e.g. US survey feet, with its metres
    double linearMetres = 1;
    // Column, row (0 first in the file), band (0 first).
    std::function<double(int, int, int)> value = [](int, int, int) { return 0.0; };
    std::function<void(GDALDataset&)> adorn = [](GDALDataset&) {};  // what else it says, before it is written
    std::vector<const char*> options;                               // options of the driver: "TILED=YES"
};

inline std::string wktOfEpsg(const RasterSpec& spec) {
    OGRSpatialReference system;
    system.importFromEPSG(spec.epsg);
    if (spec.linearUnit) system.SetLinearUnitsAndUpdateParameters(spec.linearUnit, spec.linearMetres);
    char* text = nullptr;
    system.exportToWkt(&text);
    const std::string wkt = text;
    CPLFree(text);
    return wkt;
}

inline void fillRaster(GDALDataset& dataset, const RasterSpec& spec) {
    std::vector<double> row(static_cast<std::size_t>(spec.width));
    for (int b = 0; b < spec.bands; ++b)
        for (int r = 0; r < spec.height; ++r) {
            for (int c = 0; c < spec.width; ++c) row[c] = spec.value(c, r, b);
            ASSERT_EQ(dataset.GetRasterBand(b + 1)->RasterIO(GF_Write, 0, r, spec.width, 1, row.data(),
                                                             spec.width, 1, GDT_Float64, 0, 0, nullptr),
                      CE_None);
        }
}

// Writes through the in-memory driver, so that formats which can only be copied to (PNG, JPEG) work too.
inline std::filesystem::path writeRaster(const std::filesystem::path& file, const RasterSpec& spec) {
    GDALAllRegister();
    auto* manager = GetGDALDriverManager();
    GDALDataset* memory =
        manager->GetDriverByName("MEM")->Create("", spec.width, spec.height, spec.bands, spec.type, nullptr);
    if (spec.placed) {
        auto transform = spec.transform;
        memory->SetGeoTransform(transform.data());
        if (spec.epsg != 0) memory->SetProjection(wktOfEpsg(spec).c_str());
    }
    GDALRasterBand& band = *memory->GetRasterBand(1);
    if (spec.hasNodata) band.SetNoDataValue(spec.nodata);
    if (spec.unit) band.SetUnitType(spec.unit);
    if (spec.bands >= 3)
        for (int b = 0; b < 3; ++b)
            memory->GetRasterBand(b + 1)->SetColorInterpretation(
                static_cast<GDALColorInterp>(GCI_RedBand + b));
    fillRaster(*memory, spec);
    spec.adorn(*memory);
    std::vector<const char*> options = spec.options;
    options.push_back(nullptr);
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALDataset* copy = manager->GetDriverByName(spec.driver)
                            ->CreateCopy(file.string().c_str(), memory, FALSE,
                                         const_cast<char**>(options.data()), nullptr, nullptr);
    CPLPopErrorHandler();
    EXPECT_NE(copy, nullptr) << file;
    if (copy) GDALClose(copy);
    GDALClose(memory);
    return file;
}

// "" where the folder of real data is absent.
inline std::filesystem::path realData(const std::string& name) {
    const char* named = std::getenv("STEREONAV_TEST_DATA");
    const std::filesystem::path root = named ? named : STEREONAV_SOURCE_DIR "/../shared/data";
    const std::filesystem::path file = root / "terrain" / name;
    return std::filesystem::exists(file) ? file : std::filesystem::path();
}

// The message of the Error that `call` throws; "" when it throws none.
inline std::string errorOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace stereonav::test
