// Chooses the files of a folder that are heights. Producers add counts of scenes, masks and errors, and users
// keep slope, hillshade and photographs beside them.
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
    std::unique_ptr<OGRSpatialReference> system;  // null: it names no reference system
    bool placed = false, northUp = false;
    FilePlan plan;
    HeightBand band;
    GDALDataType type = GDT_Unknown;
};

struct FolderChoice {
    std::vector<FolderFile> files;   // at least one, in the order of their names
    std::vector<std::string> notes;  // omitted files and reasons, one line each
};

// files: at least one. Omits files that can not be heights: pictures, and other units. Where one of two files
// covers the other, but their numbers are not those of one ground, the more likely heights are taken: by
// unit, type, range, steps from sample to sample, the value for missing samples, and name. Files named like
// the omitted ones are omitted as well. Where none is more likely all stay, with a note. Samples are read
// only of such files. Throws Error where a file is no raster, or none holds heights.
FolderChoice chooseHeights(const std::vector<std::filesystem::path>& files, const GdalMessages& messages);

}  // namespace stereonav
