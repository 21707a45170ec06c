// Pieces of air in a study, or of a mask, for display in its slices.
#pragma once

#include "colon/segmentation/segmentation.h"
#include "engine/scene/slices.h"

namespace stereonav {

// study: its grey values. Pieces of CT are judged as in the search for the colon, without choices; pieces of
// a mask are those in the file. Throws Cancelled.
SlicePieces slicePieces(const SliceStudy& study, const SegmentationSetting& setting, Progress& progress);

}  // namespace stereonav
