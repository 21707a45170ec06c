// Checks every file that GDAL opens, also those that other files name: in virtual rasters, metadata, and
// files beside a raster.
#pragma once

namespace stereonav {

// Adds the check before and after opening to each of these drivers (nullptr-terminated names); called once,
// after they were registered. A refusal is the error kRefused (local_files.h). Refused are names that are no
// plain files of this machine; virtual rasters as in checkOpenedVirtualRaster(); overviews that metadata
// place elsewhere; reference systems that name a path (reference_files.h); blocks that do not fit into
// memory; netCDF files whose numbers lie in another file; and files beside a database that are no plain
// files.
void guardDrivers(const char* const* names);

}  // namespace stereonav
