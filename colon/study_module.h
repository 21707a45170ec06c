// What the readers of studies ask of the module stereonav_itk (ITK, GDCM); colon/itk has the functions.
#pragma once

#include "colon/study_parts.h"

namespace stereonav {

struct StudyFunctions {
    decltype(&stereonav::readVolumeFile) readVolumeFile;
    decltype(&stereonav::scanFolder) scanFolder;
    decltype(&stereonav::chooseSeries) chooseSeries;
    decltype(&stereonav::readDicom) readDicom;
};

}  // namespace stereonav
