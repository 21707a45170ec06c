// Elevation samples on another grid. The third part of readDem().
#pragma once

#include <filesystem>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/raster/georeference.h"

namespace stereonav {

struct ResampledDem {
    std::vector<float> heights;  // rows of the target, its first row first; NaN: missing
    long long outside = 0;       // number of heights beyond the source's outer samples
};

// Samples of `source`, in its row order, at the pixels of `target`. Missing where the nearest sample is
// missing, so that holes keep their size. What holds for each height, whatever the ground: - it lies between
// the lowest and the highest of the four source samples around it; - each summit and each pit of the source
// (no higher, or no lower, sample among its eight neighbours) that lies on   the target has a sample of just
// its height, at most one source sample away along rows and columns: the   nearest one, unless that is a
// summit or pit already. This needs a target that is not coarser than the   source; where it is, what is not
// held is the lesser of what meets in one sample. Throws Error that names `file` where there is no way
// between the reference systems; Cancelled.
ResampledDem resampleDem(const std::vector<float>& samples, const Georeference& source,
                         const Georeference& target, const std::filesystem::path& file, Progress& progress);

}  // namespace stereonav
