// What the readers of studies ask of the module stereonav_gdcm; colon/gdcm has the functions.
#pragma once

#include "colon/study_parts.h"

namespace stereonav {

struct StudyFunctions {
    decltype(&stereonav::scanFolder) scanFolder;
    decltype(&stereonav::chooseSeries) chooseSeries;
    decltype(&stereonav::readDicom) readDicom;
};

}  // namespace stereonav
