// Ground to be shown while the tiles of a large one are made: some of its samples.
#pragma once

#include <optional>

#include "terrain/ground/heightfield.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

// Reads at most file.standInSide, squared, samples of the whole ground, missing ones left open; every second,
// fourth or eighth of them each way where all would take more than some 1.5 seconds to read. Of compressed
// blocks without overviews as many as that time gives, and a smooth surface between (DemRows::readSpread()).
// Returns nothing where these are slow too, where the ground has no more samples than that, or where it can
// not be read: making the tiles then says why. whole: what DemRows gives of all of it.
std::optional<Heightfield> standInGround(const SceneFile& file, const DemGrid& whole);

}  // namespace stereonav
