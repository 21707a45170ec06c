// A ground to show while the tiles of a large one are being made, from some of its samples.
#pragma once

#include <optional>

#include "terrain/ground/heightfield.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

// Reads at most file.standInSide^2 samples of the whole ground; missing ones stay open. Takes every second,
// fourth or eighth sample in each direction where reading all would take more than about 1.5 seconds. From
// compressed blocks without overviews it takes as many blocks as can be read in that time, with a smooth
// surface between (DemRows::readSpread()). Empty where these are too slow as well, where the ground has no
// more samples than that, or where it can not be read, which making the tiles will report. whole: from
// DemRows, for all of the ground.
std::optional<Heightfield> standInGround(const SceneFile& file, const DemGrid& whole);

}  // namespace stereonav
