// Keeps GDAL from reading network addresses, pipes and devices, however a file names them.
#pragma once

#include <cpl_error.h>

#include <string>

namespace stereonav {

// The number of errors that are refusals by this program; their text is a whole line.
constexpr CPLErrorNum kRefused = 4200;

// Raises this line as an error in GDAL.
void refuseToGdal(const std::string& line);

// Applies to the whole process, to be called before anything is opened: all file systems except local files,
// memory and archives refuse access, network requests are refused, and pipes and devices do not exist for
// GDAL. Settings in the user's environment no longer have an effect on that.
void keepGdalToLocalFiles();

}  // namespace stereonav
