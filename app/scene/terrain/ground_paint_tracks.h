// Tracks and places from files, on a terrain that is shown.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/render/eye_painter.h"
#include "engine/render/paint_legend.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Returns the painter of the lines, borders and places of a GPX or GeoJSON file. Adds to `legend` what is
// drawn, with lines and places, and a note on how much lies outside the ground. terrain and fog must outlive
// the painter. Throws Error where nothing lies on the ground.
std::shared_ptr<const EyePainter> trackPainter(const TerrainScene& terrain, const Fog& fog,
                                               const std::string& file, PaintLegend& legend);

// Returns the file's only track as a flight over the terrain. Throws Error where the file has several tracks,
// or the track leaves the ground.
RecordedPath followedTrack(const TerrainScene& terrain, const std::string& file, double height);

}  // namespace stereonav
