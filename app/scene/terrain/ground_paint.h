// Paint on a terrain's ground as the options ask for it, and its legend.
#pragma once

#include <memory>
#include <string>

#include "app/options/scene_options.h"
#include "engine/render/eye_painter.h"
#include "engine/render/paint_legend.h"
#include "engine/scene/facts.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Returns the paint that replaces a terrain's tints when it is loaded; None where --paint names another kind.
GroundPaint groundPaintOf(const SceneOptions& options);
GroundPaint groundPaintOf(const std::string& paint);  // for a value of --paint

// Returns the painter of contours, null where the options ask for none. legend: gets an entry. terrain and
// fog must outlive the painter.
std::shared_ptr<const EyePainter> contoursOf(const TerrainScene& terrain, const Fog& fog,
                                             const GroundPaintOptions& options, PaintLegend& legend);

// Adds the legend to the facts of a scene; nothing where nothing is painted.
void addLegend(const PaintLegend& legend, Facts& facts);

}  // namespace stereonav
