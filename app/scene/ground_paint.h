// What the options paint on a terrain's ground, and what that means.
#pragma once

#include <memory>
#include <vector>

#include "app/command/commands.h"
#include "engine/base/progress.h"
#include "engine/render/eye_painter.h"
#include "engine/render/paint_legend.h"
#include "engine/scene/facts.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// The paint that a terrain is loaded with, in the place of its tints; None where --paint says another.
GroundPaint groundPaintOf(const SceneOptions& options);

// One over the other, in this order; none where nothing is asked for. legend: gets what the colours mean, of
// groundPaintOf() too. terrain, fog: outlive them. Throws Error, Cancelled.
std::vector<std::shared_ptr<const EyePainter>> groundPainters(const TerrainScene& terrain, const Fog& fog,
                                                              const SceneOptions& options,
                                                              PaintLegend& legend, Progress& progress);

// Adds what is painted to what a scene says of itself; nothing where nothing is.
void addLegend(const PaintLegend& legend, Facts& facts);

}  // namespace stereonav
