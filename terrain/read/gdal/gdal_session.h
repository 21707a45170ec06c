// The only interface to GDAL: registers its drivers once, catches its messages instead of printing them, and
// closes its handles. Used by the readers of elevation models and ground images; no other header names GDAL.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "terrain/raster/georeference.h"
#include "terrain/read/dem_reader.h"

namespace stereonav {

// Bytes of decoded blocks that GDAL keeps, unless the user sets GDAL_CACHEMAX; at most a quarter of the
// available memory. Files are read in runs of rows, for which a row of blocks is enough.
constexpr int kGdalBlocks = 64 << 20;

// While such an object lives, GDAL's messages of this thread are kept in it and nothing is printed.
class GdalMessages {
public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    bool hasError() const { return !mFirstError.empty(); }
    // Returns " (what went wrong)", without the file's own name; "" when there was no error.
    std::string reason(const std::filesystem::path& file) const;
    // Throws Error where access to something that the file names was refused (guarded_drivers.h).
    void throwIfRefused(const std::filesystem::path& file) const;
    void clear() { mFirstError.clear(), mRefused.clear(); }

private:
    static void CPL_STDCALL keep(CPLErr level, CPLErrorNum number, const char* text);
    std::string mFirstError, mRefused;
};

struct CloseDataset {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using GdalDataset = std::unique_ptr<GDALDataset, CloseDataset>;

// Throws Error unless the path is a file with content on this machine.
void checkFileForGdal(const std::filesystem::path& file, const std::string& advice);

// Returns the name for GDAL: an absolute path, so that no driver takes it for its own syntax.
std::string nameForGdal(const std::filesystem::path& file);

// Opens a raster that this program can read, after checking that it is a file with content. `expected`
// completes the sentence "expected ..." and `advice` says what to give instead. notes: receives remarks for
// the user, a line each. Throws Error.
GdalDataset openRaster(const std::filesystem::path& file, const GdalMessages& messages,
                       const std::string& expected, const std::string& advice,
                       std::vector<std::string>* notes = nullptr);

// Returns the raster's place, by its transform or its control points. known: set to whether the file has one
// (else a unit per pixel, without a system). The system is that of the plan, without heights. Throws Error
// for control points that do not determine a place.
Georeference georeferenceOf(GDALDataset& dataset, const std::filesystem::path& file, bool& known);

// Returns the system as WKT 2, on one line; "" for none.
std::string wktOf(const OGRSpatialReference& system);
// Returns the WKT without the vertical system of a compound one.
std::string planWkt(const OGRSpatialReference& system);

// Largest number of samples of a raster: per side, and in total.
struct RasterLimits {
    long long side = 0, samples = 0;
};
// Limits for rasters that are read at once: 1 GiB of heights, and as much again for pyramid and colour.
constexpr RasterLimits kReadAtOnce = {kMostDemSide, kMostDemSamples};
// Limits for rasters that are read in runs of rows.
constexpr RasterLimits kReadByRows = {1ll << 20, 1ll << 40};

// Throws Error unless both sides are 1 or more, and within the limits.
void checkRasterSize(const std::filesystem::path& file, long long width, long long height,
                     const RasterLimits& limits = kReadAtOnce);

}  // namespace stereonav
