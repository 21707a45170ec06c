// What the options paint on a terrain's ground, and what that means.
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

// The paint that a terrain is loaded with, in the place of its tints; None where --paint says another.
GroundPaint groundPaintOf(const SceneOptions& options);
GroundPaint groundPaintOf(const std::string& paint);  // a value of --paint

// Null where there are none. legend: gets what they mean. terrain, fog: outlive it.
std::shared_ptr<const EyePainter> contoursOf(const TerrainScene& terrain, const Fog& fog,
                                             const GroundPaintOptions& options, PaintLegend& legend);

// Adds what is painted to what a scene says of itself; nothing where nothing is.
void addLegend(const PaintLegend& legend, Facts& facts);

}  // namespace stereonav
