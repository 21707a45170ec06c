// Terrain as a height volume (Kniss et al. 2003, section 3.4; row K7 of docs/ledger.md), and mist over it.
#pragma once

#include "app/options/scene_options.h"
#include "engine/medium/model/medium.h"
#include "engine/medium/sweep/sweep_setting.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Returns the ground as a layer in its own colours, read in place from the scene's texture, or under a
// transfer function over the height; with --mist a second layer. The coarser the sweep, the more gradually
// the ground begins. The scene must outlive the medium. Throws Error.
Medium terrainMedium(const TerrainScene& terrain, const MediumOptions& options, const SweepSetting& sweep);

// Returns the scene's sky in a unit world direction, linear RGB, bilinear between texels.
glm::vec3 skyAt(const SkyMap& sky, const glm::dvec3& direction);

}  // namespace stereonav
