// Paint by results of instruments for each sample of the ground: --paint viewshed and --paint hours.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "app/scene/terrain/survey_ground.h"
#include "engine/base/progress.h"
#include "engine/render/eye_painter.h"
#include "engine/render/paint_legend.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Returns the painter for `paint`, a value of --paint; null where surveyed() is false for it. survey: the
// same ground with its reference system. terrain and fog must outlive the painter. Throws Error, Cancelled.
std::shared_ptr<const EyePainter> surveyPainter(const TerrainScene& terrain, const Fog& fog,
                                                const SurveyGround& survey, const std::string& paint,
                                                PaintLegend& legend, Progress& progress);
bool surveyed(const std::string& paint);

// Returns the value of --paint for a viewshed from `height` above the ground at world x, y. Throws Error.
std::string paintSeenFrom(const SurveyGround& survey, const glm::dvec2& world, double height);

}  // namespace stereonav
