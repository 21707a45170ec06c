// Tracks and places out of files, on a terrain that is shown.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/render/eye_painter.h"
#include "engine/render/paint_legend.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Draws the lines, borders and places of a GPX or GeoJSON file; says in `legend` what it drew, with its lines
// and places, and in a note how much lies beside the ground. terrain, fog: outlive it. Throws Error where
// nothing lies on the ground.
std::shared_ptr<const EyePainter> trackPainter(const TerrainScene& terrain, const Fog& fog,
                                               const std::string& file, PaintLegend& legend);

// The file's one track as a flight of the terrain. Throws Error where there are several, and where it leaves
// the ground.
RecordedPath followedTrack(const TerrainScene& terrain, const std::string& file, double height);

}  // namespace stereonav
