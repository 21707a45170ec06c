// Resamples elevation samples to another grid. The third part of readDem().
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

// Resamples `source`, in its row order, to the pixels of `target`. A pixel is missing where the nearest
// sample is missing, so that holes keep their size. Guarantees, for any ground:
// - each height lies between the lowest and the highest of the four source samples around it;
// - each summit and pit of the source (no higher, or no lower, sample among its eight neighbours) on the
//   target keeps its exact height in a sample at most one source sample away along rows and columns: the
//   nearest one, unless that is a summit or pit already. This needs a target that is not coarser than the
//   source; on a coarser one, of several that fall on one sample the lesser are lost.
// Throws Error that names `file` where there is no conversion between the reference systems; Cancelled.
ResampledDem resampleDem(const std::vector<float>& samples, const Georeference& source,
                         const Georeference& target, const std::filesystem::path& file, Progress& progress);

}  // namespace stereonav
