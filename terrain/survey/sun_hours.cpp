#include "terrain/survey/sun_hours.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// A sun's direction: grid units and metres of height a metre of the plan.
struct SunRay {
    glm::dvec2 step;
    double climb;
};

SunRay rayTo(const SunOverGround& sun, const glm::dvec2& spacing) {
    return {glm::dvec2(std::sin(sun.azimuth), std::cos(sun.azimuth)) / spacing, std::tan(sun.elevation)};
}

// Metres over the plan until the line leaves the ground, or is above all of it.
double reachOf(const Heightfield& ground, const glm::dvec2& from, double height, const SunRay& ray) {
    double reach =
        ray.climb > 0 ? (ground.maxHeight() - height) / ray.climb : std::numeric_limits<double>::infinity();
    const glm::dvec2 last(ground.width() - 1, ground.height() - 1);
    for (const int axis : {0, 1}) {
        if (ray.step[axis] > 0) reach = std::min(reach, (last[axis] - from[axis]) / ray.step[axis]);
        if (ray.step[axis] < 0) reach = std::min(reach, -from[axis] / ray.step[axis]);
    }
    return std::max(reach, 0.0);
}

bool shinesOn(const SightLines& lines, int i, int j, const SunRay& ray) {
    const Heightfield& ground = lines.ground();
    const glm::dvec2 from(i, j);
    const double height = ground.sample(i, j), reach = reachOf(ground, from, height, ray);
    if (reach == 0) return true;
    return lines.sees({from, height}, {from + reach * ray.step, height + reach * ray.climb});
}

}  // namespace

bool sunShinesOn(const SightLines& lines, int i, int j, const SunOverGround& sun) {
    return sun.elevation >= 0 && shinesOn(lines, i, j, rayTo(sun, lines.ground().spacing()));
}

Plane<float> hoursOfSun(const SightLines& lines, const std::vector<SunOverGround>& suns, double hours,
                        Progress& progress) {
    const Heightfield& ground = lines.ground();
    std::vector<SunRay> rays;
    for (const SunOverGround& sun : suns)
        if (sun.elevation >= 0) rays.push_back(rayTo(sun, ground.spacing()));
    Plane<float> shone(ground.width(), ground.height());
    ProgressSteps rows(progress, ground.height(), "following the sun");
    parallelFor(ground.height(), [&](int j) {
        for (int i = 0; i < ground.width(); ++i) {
            int count = 0;
            for (const SunRay& ray : rays) count += shinesOn(lines, i, j, ray);
            shone.row(j)[i] = std::isfinite(ground.sample(i, j))
                                  ? static_cast<float>(hours * count / static_cast<double>(suns.size()))
                                  : std::numeric_limits<float>::quiet_NaN();
        }
        rows.done();
    });
    return shone;
}

}  // namespace stereonav
