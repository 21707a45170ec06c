// The pieces of air in a study, or of a mask, as its slices show them.
#pragma once

#include "colon/segmentation/segmentation.h"
#include "engine/scene/slices.h"

namespace stereonav {

// study: its grey values. Of CT the pieces are judged as when the colon was looked for, without choices; of a
// mask they are what it holds. Throws Cancelled.
SlicePieces slicePieces(const SliceStudy& study, const SegmentationSetting& setting, Progress& progress);

}  // namespace stereonav
