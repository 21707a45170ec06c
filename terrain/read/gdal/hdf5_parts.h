// netCDF files of the newer kind are HDF5, which may have their numbers in any other file of the machine.
#pragma once

#include <string>

namespace stereonav {

// name: as GDAL is given it, a file's or a variable's ("NETCDF:"/...":x"). Throws Error that names the file
// where it is HDF5 and leads to other files: numbers kept outside, links, datasets put together of others, of
// which nothing is opened; and where something in it can not be opened, which netCDF's library does not bear.
void checkHdf5Parts(const std::string& name);

}  // namespace stereonav
