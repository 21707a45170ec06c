// `stereonav info FOLDER --series-pictures DIR`: lists the series of a DICOM folder, with a picture of each.
#pragma once

#include "app/options/picture_options.h"

namespace stereonav {

// Prints the list and writes DIR/series_1.png and so on. Returns the exit status. Throws Error.
int listSeriesOf(const InfoOptions& options);

}  // namespace stereonav
