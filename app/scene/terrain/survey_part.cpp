#include "app/scene/terrain/survey_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/text/length_text.h"
#include "terrain/read/dem_reader.h"
#include "terrain/scene/tiled_ground.h"

namespace stereonav {
namespace {

// A rectangle of samples of one level.
struct Window {
    int level = 0;
    glm::ivec2 low{0}, size{0};
    double samples() const { return double(size.x) * size.y; }
};

Window windowAt(const GroundLevels& levels, int level, const glm::dvec2& world, double reach) {
    const glm::ivec2 all = levels.size(level);
    if (reach <= 0) return {level, glm::ivec2(0), all};
    const glm::dvec2 middle = levels.gridFromWorld(world) / double(1 << level),
                     side = reach / levels.spacing(level), last(all - 1);
    const glm::ivec2 low(glm::clamp(glm::floor(middle - side), glm::dvec2(0), last - 1.0));
    const glm::ivec2 high(glm::clamp(glm::ceil(middle + side), glm::dvec2(low + 1), last));
    return {level, low, high - low + 1};
}

// Returns the finest window that fits into a share of the memory; GDAL, which writes the result, needs some
// too.
Window finestWindow(const GroundLevels& levels, const glm::dvec2& world, double reach) {
    constexpr double kShare = 0.8;
    const double room = kShare * availableMemory();
    const double most = reach > 0 ? double(kMostDemSamples) : kMostCoarseSamples;
    for (int level = 0;; ++level) {
        const Window window = windowAt(levels, level, world, reach);
        const bool fits = window.samples() <= most && bytesOfSurvey(window.samples()) <= room;
        if (fits || level + 1 == levels.count()) return window;
    }
}

// Returns the grid of a window's samples; `whole` is the grid of all finest samples, north up.
Georeference gridOf(const Georeference& whole, const Window& window) {
    const double step = 1 << window.level;
    const glm::dvec2 first = step * glm::dvec2(window.low), last = first + step * glm::dvec2(window.size - 1);
    // Pixels of the finest grid, whose rows count from the north, at the outer corner of this one.
    const glm::dvec2 corner(first.x + 0.5 - 0.5 * step, whole.height - 0.5 - last.y - 0.5 * step);
    Georeference grid;
    grid.wkt = whole.wkt;
    grid.width = window.size.x, grid.height = window.size.y;
    const glm::dvec2 origin = whole.fromPixel(corner);
    const auto& t = whole.transform;
    grid.transform = {origin.x, step * t[1], step * t[2], origin.y, step * t[4], step * t[5]};
    return grid;
}

}  // namespace

SurveyPart::SurveyPart(const SurveyGround& survey, const glm::dvec2& world, double reach)
    : mSurvey(survey), mGrid(survey.grid) {
    if (!survey.tiles) return;
    const GroundLevels& levels = survey.tiles->levels();
    const Window window = finestWindow(levels, world, reach);
    mOwn = levels.part(window.level, window.low, window.size);
    if (!mOwn) throw Error(survey.name, "", "no height is known there", "choose another place");
    mGrid = gridOf(survey.grid, window);
}

std::string SurveyPart::words() const {
    const double spacing = ground().spacing().x, finest = mSurvey.samples().spacing().x;
    std::string text = fmt::format("samples {} apart", lengthText(spacing));
    if (spacing > finest) text += fmt::format(", the finest are {}", lengthText(finest));
    return text;
}

Facts SurveyPart::facts() const {
    const glm::dvec2 spacing = ground().spacing(), finest = mSurvey.samples().spacing();
    return {factForJson("sample_spacing_m", FactNumbers{spacing.x, spacing.y}),
            factForJson("finest_spacing_m", FactNumbers{finest.x, finest.y})};
}

}  // namespace stereonav
