// All that GDAL opens is looked at, whoever names it: a virtual raster, the metadata of another file, a file
// beside it.
#pragma once

namespace stereonav {

// Puts the check before and behind each of these drivers (nullptr-terminated names); once, after they were
// registered. What is refused is an error kRefused (local_files.h): names that are no plain files of this
// machine; virtual rasters as checkOpenedVirtualRaster() does; overviews that metadata name elsewhere;
// reference systems that name a path (reference_files.h); blocks that do not fit into memory; netCDF whose
// numbers lie in another file; what a database has beside it and is no file.
void guardDrivers(const char* const* names);

}  // namespace stereonav
