// Checks of netCDF-4 files, which are HDF5 and may keep their numbers in any other file of the machine.
#pragma once

#include <string>

namespace stereonav {

// name: as for GDAL, of a file or a variable ("NETCDF:"/...":x"). Throws Error that names the file where it
// is HDF5 and refers to other files (external storage, links, virtual datasets), none of which is opened; and
// where something in it can not be opened, since netCDF's library would crash.
void checkHdf5Parts(const std::string& name);

}  // namespace stereonav
