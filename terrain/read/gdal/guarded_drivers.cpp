#include "terrain/read/gdal/guarded_drivers.h"

#include <cpl_string.h>
#include <gdal_priv.h>

#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "terrain/read/gdal/block_memory.h"
#include "terrain/read/gdal/gdal_session.h"
#include "terrain/read/gdal/hdf5_parts.h"
#include "terrain/read/gdal/local_files.h"
#include "terrain/read/gdal/reference_files.h"
#include "terrain/read/gdal/vrt_check.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

using OpenFunction = GDALDataset* (*)(GDALOpenInfo*);

std::map<const GDALDriver*, OpenFunction>& openFunctions() {
    static std::map<const GDALDriver*, OpenFunction> functions;
    return functions;
}

// GDAL takes much else for a name: a virtual raster's whole text, a driver's own words before a colon, which
// may be followed by an address. These are of a variable of a netCDF file, and of the database of MBTiles.
void checkName(const std::string& name) {
    const bool whole =
        name.starts_with('/') || name.starts_with("NETCDF:\"/") || name.starts_with("SQLITE:/");
    if (name.find("://") == std::string::npos && (whole || name.find_first_of(":<") == std::string::npos))
        return;
    throw Error(name.substr(0, 200), "", "expected the name of a file on this machine, found something else",
                "name the file itself");
}

// SQLite opens these itself, and waits at a pipe.
void checkBesideDatabase(const std::string& name) {
    for (const char* end : {"-journal", "-wal", "-shm"}) {
        std::error_code code;
        const auto beside = fs::status(name + end, code);
        if (fs::exists(beside) && !fs::is_regular_file(beside))
            throw Error(name + end, "", "expected a file, found a pipe or a device", "take it away");
    }
}

// Options that virtual rasters may give for their files: one lets text of SQL run, the other moves the
// folder that names are relative to.
void checkOptions(const std::string& name, const char* const* options) {
    for (const char* option : {"PRELUDE_STATEMENTS", "ROOT_PATH"})
        if (CSLFetchNameValue(options, option))
            throw Error(name, "", std::string("is not opened with the option ") + option,
                        "take it out of the virtual raster");
}

void checkBefore(GDALDriver& driver, GDALOpenInfo& info) {
    const std::string name = info.pszFilename;
    checkName(name);
    checkOptions(name, info.papszOpenOptions);
    if (driver.pfnIdentify && driver.pfnIdentify(&info) == GDAL_IDENTIFY_FALSE) return;
    checkReferencesBeside(name);
    const std::string_view of = driver.GetDescription();
    if (of == "VRT" && !name.starts_with(kOwnVirtualRasters)) checkOpenedVirtualRaster(name);
    if (of == "netCDF") checkHdf5Parts(name);
    if (of == "GPKG" || of == "MBTiles" || of == "SQLite") checkBesideDatabase(name);
}

// Metadata may name another file for coarser samples.
void checkOverviews(GDALDataset& dataset, const std::string& name) {
    const char* const value = dataset.GetMetadataItem("OVERVIEW_FILE", "OVERVIEWS");
    if (!value) return;
    constexpr const char* kBase = ":::BASE:::";
    const fs::path folder = fs::path(name).parent_path(),
                   file = STARTS_WITH_CI(value, kBase) ? folder / (value + std::string_view(kBase).size())
                                                       : fs::path(value);
    std::error_code code;
    if (!fs::exists(file, code) || liesBelow(folder, file)) return;  // what is not there is not read either
    throw Error(name, "OVERVIEW_FILE", "names " + file.string() + ", which lies outside its folder",
                "take that entry out of its metadata");
}

GDALDataset* openGuarded(GDALDriver* driver, GDALOpenInfo* info) {
    try {
        checkBefore(*driver, *info);
        GdalDataset dataset(openFunctions().at(driver)(info));
        if (!dataset) return nullptr;
        const std::string name = info->pszFilename;
        if (!*dataset->GetDescription()) dataset->SetDescription(name.c_str());  // GDAL does it after this
        checkReference(dataset->GetSpatialRef(), name);
        checkReference(dataset->GetGCPSpatialRef(), name);
        checkOverviews(*dataset, name);
        checkBlocks(*dataset, driver->GetDescription(), name);
        return dataset.release();
    } catch (const std::exception& error) {  // none may pass through GDAL
        refuseToGdal(error.what());
        return nullptr;
    }
}

}  // namespace

void guardDrivers(const char* const* names) {
    for (const char* const* name = names; *name; ++name) {
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(*name);
        if (!driver || !driver->pfnOpen || driver->pfnOpenWithDriverArg) continue;
        openFunctions()[driver] = driver->pfnOpen;
        driver->pfnOpenWithDriverArg = openGuarded;
        driver->pfnOpen = nullptr;  // it would go before
    }
}

}  // namespace stereonav
