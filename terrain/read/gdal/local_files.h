// GDAL asks no address and waits for no pipe, however a file spells what it names.
#pragma once

#include <cpl_error.h>

#include <string>

namespace stereonav {

// The number of errors that are the program's own refusals: their text is a whole line.
constexpr CPLErrorNum kRefused = 4200;

// Has GDAL fail with that line.
void refuseToGdal(const std::string& line);

// For the whole process, before anything is opened: all file systems but those of local files, memory and
// archives refuse, requests over the network do, and pipes and devices are not there. What the user's
// environment says of it no longer counts.
void keepGdalToLocalFiles();

}  // namespace stereonav
