// The door to GDAL: its drivers registered once, its messages caught instead of printed, its handles
// closed. Used by the readers of elevation models and ground images; no header outside names GDAL.
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "terrain/raster/georeference.h"
#include "terrain/read/dem_reader.h"

namespace stereonav {

// Bytes of blocks of files that GDAL keeps, unless the user says otherwise (GDAL_CACHEMAX); at most a quarter
// of the memory that can be had. Files are read in runs of rows: a row of blocks is enough.
constexpr int kGdalBlocks = 64 << 20;

// While it lives, GDAL's messages of this thread are kept here and nothing is printed.
class GdalMessages {
public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    bool hasError() const { return !mFirstError.empty(); }
    // " (what went wrong)", without the file's own name; "" when there was no error.
    std::string reason(const std::filesystem::path& file) const;
    // Where something that the file names was refused (guarded_drivers.h): throws Error that says so.
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

// Throws Error unless it is a file with content on this machine.
void checkFileForGdal(const std::filesystem::path& file, const std::string& advice);

// The name that GDAL is given: whole, so that no driver takes it for words of its own.
std::string nameForGdal(const std::filesystem::path& file);

// A raster this program can read, checked to be a file with content. `expected` completes the
// sentence "expected ..." and `advice` says what to give instead. notes: gets what a person should know of
// it, a line each. Throws Error.
GdalDataset openRaster(const std::filesystem::path& file, const GdalMessages& messages,
                       const std::string& expected, const std::string& advice,
                       std::vector<std::string>* notes = nullptr);

// Where the raster lies, by its transform or its control points; `known` is set to whether the file says so
// (else a unit a pixel, no system). The system is that of the plan, without heights. Throws Error for control
// points that place nothing.
Georeference georeferenceOf(GDALDataset& dataset, const std::filesystem::path& file, bool& known);

// Returns the system as WKT 2, on one line; "" for none.
std::string wktOf(const OGRSpatialReference& system);
// Returns the WKT without the system of heights that a compound one has.
std::string planWkt(const OGRSpatialReference& system);

// Samples that a raster may have: a side, and in all.
struct RasterLimits {
    long long side = 0, samples = 0;
};
// Limits of what is read at once: 1 GiB of heights; as much again for the pyramid and colour.
constexpr RasterLimits kReadAtOnce = {kMostDemSide, kMostDemSamples};
// Limits of what is read a run of rows at a time.
constexpr RasterLimits kReadByRows = {1ll << 20, 1ll << 40};

// Throws Error unless both sides are 1 or more, and within the limits.
void checkRasterSize(const std::filesystem::path& file, long long width, long long height,
                     const RasterLimits& limits = kReadAtOnce);

}  // namespace stereonav
