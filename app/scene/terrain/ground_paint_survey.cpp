#include "app/scene/terrain/ground_paint_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "app/options/number_text.h"
#include "app/options/option_numbers.h"
#include "app/options/paint_words.h"
#include "app/options/utc_text.h"
#include "app/scene/terrain/survey_sun.h"
#include "engine/base/error.h"
#include "engine/image/packed_color.h"
#include "engine/text/length_text.h"
#include "terrain/ground/height_pyramid.h"
#include "terrain/paint/raster_painter.h"
#include "terrain/survey/viewshed.h"

namespace stereonav {
namespace {

constexpr const char *kSeenFrom = "viewshed", *kHours = "hours";
constexpr double kUsualEyeHeight = 2;  // metres above the ground, as for the command viewshed
constexpr double kSunStep = 20 * 60;   // seconds, as for the command sun
constexpr float kHiddenShare = 0.62f, kHoursShare = 0.6f;
const glm::vec3 kHiddenColor(0.02f, 0.01f, 0.06f);
// Colours from few hours to many: six classes of ColorBrewer's YlOrRd in reverse order, as sRGB.
constexpr std::array<std::array<int, 3>, 6> kHoursColors{
    {{35, 20, 60}, {128, 0, 38}, {227, 26, 28}, {253, 141, 60}, {254, 217, 118}, {255, 255, 204}}};

glm::vec3 hoursColor(std::size_t n) {
    const auto channel = [&](std::size_t c) {
        return linearFromSrgb(static_cast<float>(kHoursColors[n][c]) / 255.0f);
    };
    return {channel(0), channel(1), channel(2)};
}

// Returns the sample spacing as text where it is coarser than the finest samples, else "".
std::string apart(const Heightfield& ground, const SurveyGround& survey) {
    const double spacing = ground.spacing().x;
    return spacing > survey.samples().spacing().x ? fmt::format(", by samples {} apart", lengthText(spacing))
                                                  : "";
}

std::shared_ptr<const EyePainter> viewshedPainter(const TerrainScene& terrain, const Fog& fog,
                                                  const SurveyGround& survey, const std::string& place,
                                                  PaintLegend& legend, Progress& progress) {
    const std::vector<double> numbers = numbersIn("--paint", groundPlaceNumbers(), place).numbers;
    const Heightfield& ground = terrain.ground;  // for ground in tiles: the level in memory
    const glm::dvec2 eye = survey.gridAt({numbers[0], numbers[1]}, "--paint");
    survey.heightAt(eye, "--paint");
    ViewshedSetting setting;
    setting.eye = ground.gridFromWorld(survey.samples().worldFromGrid(eye));
    setting.eyeHeight = numbers.size() > 2 ? numbers[2] : kUsualEyeHeight;
    setting.fall = terrain.lens.fall / terrain.verticalScale;
    const Viewshed shed = viewshedOf(ground, setting, progress);
    Plane<float> hidden(shed.seen.width(), shed.seen.height());
    for (int j = 0; j < hidden.height(); ++j)
        for (int i = 0; i < hidden.width(); ++i) {
            const auto seen = static_cast<Seen>(shed.seen.at(i, j));
            hidden.at(i, j) = seen == Seen::NoGround ? std::nanf("") : seen == Seen::Hidden ? 1.0f : 0.0f;
        }
    const double percent = shed.samples > 0 ? 100.0 * shed.visible / shed.samples : 0;
    legend.legends.push_back(
        {fmt::format("seen from {}", place),
         {{kHiddenColor, fmt::format("hidden; {:.1f} % is seen{}", percent, apart(ground, survey))}}});
    return std::make_shared<RasterPainter>(
        terrain.ground, fog, std::move(hidden),
        std::vector<PaintStop>{{kHiddenColor, 0}, {kHiddenColor, kHiddenShare}});
}

std::shared_ptr<const EyePainter> hoursPainter(const TerrainScene& terrain, const Fog& fog,
                                               const SurveyGround& survey, const std::string& day,
                                               PaintLegend& legend, Progress& progress) {
    const Heightfield& ground = terrain.ground;  // for ground in tiles: the level in memory
    const HeightPyramid maxima(ground);
    const SightLines lines(ground, maxima, 0);
    const double time = secondsFromText(day).value_or(0);
    Plane<float> hours = hoursOfSun(lines, sunsOfDay(sunPlaceOf(survey), time, kSunStep), 24, progress);
    float most = 0;
    for (int j = 0; j < hours.height(); ++j)
        for (int i = 0; i < hours.width(); ++i) most = std::fmax(most, hours.at(i, j));
    std::vector<PaintStop> stops;
    Legend part{"hours of sun on " + day + apart(ground, survey), {}};
    for (std::size_t n = 0; n < kHoursColors.size(); ++n) {
        stops.push_back({hoursColor(n), kHoursShare});
        part.entries.push_back(
            {hoursColor(n), fmt::format("{:.1f}", most * float(n) / (kHoursColors.size() - 1))});
    }
    for (int j = 0; most > 0 && j < hours.height(); ++j)
        for (int i = 0; i < hours.width(); ++i) hours.at(i, j) /= most;
    legend.legends.push_back(std::move(part));
    return std::make_shared<RasterPainter>(terrain.ground, fog, std::move(hours), std::move(stops));
}

}  // namespace

bool surveyed(const std::string& paint) {
    const std::string word = paintAskedOf(paint).word;
    return word == kSeenFrom || word == kHours;
}

std::shared_ptr<const EyePainter> surveyPainter(const TerrainScene& terrain, const Fog& fog,
                                                const SurveyGround& survey, const std::string& paint,
                                                PaintLegend& legend, Progress& progress) {
    const PaintAsked asked = paintAskedOf(paint);
    if (asked.word == kSeenFrom) return viewshedPainter(terrain, fog, survey, asked.rest, legend, progress);
    if (asked.word == kHours) return hoursPainter(terrain, fog, survey, asked.rest, legend, progress);
    return nullptr;
}

std::string paintSeenFrom(const SurveyGround& survey, const glm::dvec2& world, double height) {
    const auto place = survey.reference->referenceAt(world);
    if (!place)
        throw Error("--paint", "", "the place has no coordinates in the elevation model's reference system",
                    "choose another place");
    return fmt::format("{}:{:.10g},{:.10g},{:.6g}", kSeenFrom, place->x, place->y, height);
}

}  // namespace stereonav
