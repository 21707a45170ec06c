// A tile store as the levels of a ground.
#pragma once

#include <memory>

#include "terrain/ground/ground_levels.h"
#include "terrain/tiles/tile_store.h"

namespace stereonav {

// Returns levels that are read from the store. spacing: metres between samples of the finest level.
// verticalScale: factor on the store's heights, > 0.
StoredLevels storedLevels(std::shared_ptr<const TileStore> store, const glm::dvec2& spacing,
                          double verticalScale);

}  // namespace stereonav
