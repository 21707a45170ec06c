// What instruments find for each sample of the ground, painted on it: --paint viewshed and hours.
#pragma once

#include <memory>

#include "app/command/commands.h"
#include "engine/base/progress.h"
#include "engine/render/eye_painter.h"
#include "engine/render/paint_legend.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Null where options.paint asks for something else. The elevation model is read once more, for its places in
// its file's reference system. terrain, fog: outlive it. Throws Error, Cancelled.
std::shared_ptr<const EyePainter> surveyPainter(const TerrainScene& terrain, const Fog& fog,
                                                const SceneOptions& options, PaintLegend& legend,
                                                Progress& progress);

}  // namespace stereonav
