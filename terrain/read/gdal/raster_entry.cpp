// The interface of the module stereonav_gdal to the program.
#include "engine/base/module.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr RasterFunctions kFunctions = {readDem,      glanceAtDem,  openDemRows, openRasterPicture,
                                        mapPixels,    overlap,      earthPlaces, referencePlaces,
                                        writeGeoTiff, readTrackFile};

}  // namespace

const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
