// `stereonav info FOLDER --series-pictures DIR`: lists the series of a DICOM folder, with a picture of each.
#pragma once

#include <string>

#include "app/options/scene_options.h"

namespace stereonav {

// Prints the list, in words or as JSON, and writes series_1.png and so on into `folder`. Returns the exit
// status. Throws Error.
int listSeries(const SceneOptions& study, const std::string& folder, bool json);

}  // namespace stereonav
