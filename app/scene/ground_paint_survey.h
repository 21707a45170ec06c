// What instruments find for each sample of the ground, painted on it: --paint viewshed and hours.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "app/scene/survey_ground.h"
#include "engine/base/progress.h"
#include "engine/render/eye_painter.h"
#include "engine/render/paint_legend.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Null where `paint`, a value of --paint, asks for something else: surveyed() says whether it does.
// survey: the same ground, with its places in its file's reference system. terrain, fog: outlive it. Throws
// Error, Cancelled.
std::shared_ptr<const EyePainter> surveyPainter(const TerrainScene& terrain, const Fog& fog,
                                                const SurveyGround& survey, const std::string& paint,
                                                PaintLegend& legend, Progress& progress);
bool surveyed(const std::string& paint);

// The value that paints what is seen from so high above the ground there, world x, y. Throws Error.
std::string paintSeenFrom(const SurveyGround& survey, const glm::dvec2& world, double height);

}  // namespace stereonav
