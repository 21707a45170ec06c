// Which files of a folder are its heights. Producers send counts of scenes, masks and errors with them, and
// people keep slope, hillshade and photographs beside them.
#pragma once

#include <ogr_spatialref.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "terrain/read/gdal/folder_mix.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/height_band.h"

namespace stereonav {

// A file of a folder, by its header.
struct FolderFile {
    std::filesystem::path file;
    std::unique_ptr<OGRSpatialReference> system;  // null: it names none
    bool placed = false, northUp = false;
    FilePlan plan;
    HeightBand band;
    GDALDataType type = GDT_Unknown;
};

struct FolderChoice {
    std::vector<FolderFile> files;   // one and more, in the order of their names
    std::vector<std::string> notes;  // what was left aside and why, one line each
};

// files: one and more. What is no heights by itself is left aside: pictures, other units. Of two files of
// which one covers the other, and whose numbers are not the same ground's, the likelier heights are taken: by
// unit, type, range, steps from sample to sample, the value for missing samples, and name. So is left aside
// what is named as these others are. Where none is likelier all stay, and it is said. Samples are read of
// such files alone. Throws Error where a file is no raster, or none holds heights.
FolderChoice chooseHeights(const std::vector<std::filesystem::path>& files, const GdalMessages& messages);

}  // namespace stereonav
