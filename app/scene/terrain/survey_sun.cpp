#include "app/scene/terrain/survey_sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/scene/terrain/earth_alone.h"
#include "engine/base/error.h"
#include "engine/light/skies/sun_position.h"

namespace stereonav {
namespace {

constexpr double kSecondsOfDay = 86400;

}  // namespace

SunPlaceOnGround sunPlaceOf(const SurveyGround& survey) {
    const auto fail = [&](const char* problem) {
        throw Error(survey.name, "", problem, "name an elevation model that says where it lies");
    };
    expectEarth(survey.body, survey.name, "the sun goes by places on the Earth");
    if (!survey.earth) fail("does not say where it lies on the Earth, and the sun goes by that");
    const glm::dvec2 middle(0.0);
    const auto here = survey.earth->placeAt(middle);
    if (!here) fail("its middle has no longitude and latitude");
    SunPlaceOnGround place{*here, 0};
    // True north is found by a step of a hundredth of a degree, towards the farther pole.
    EarthPlace beside = *here;
    const double step = (here->latitude > 0 ? -1 : 1) * 0.01 * std::numbers::pi / 180;
    beside.latitude += step;
    if (const auto world = survey.earth->worldAt(beside)) {
        const glm::dvec2 way = (*world - middle) * (step > 0 ? 1.0 : -1.0);
        place.north = std::atan2(way.x, way.y);
    }
    return place;
}

std::vector<SunOverGround> sunsOfDay(const SunPlaceOnGround& place, double time, double step) {
    const double offset = place.earth.longitude / (2 * std::numbers::pi) * kSecondsOfDay;
    const double midnight = std::floor((time + offset) / kSecondsOfDay) * kSecondsOfDay - offset;
    const int count = std::max(1, static_cast<int>(std::lround(kSecondsOfDay / step)));
    std::vector<SunOverGround> suns;
    for (int k = 0; k < count; ++k) {
        const SunSeen seen = sunSeenAt(midnight + (k + 0.5) * kSecondsOfDay / count, place.earth.latitude,
                                       place.earth.longitude);
        suns.push_back({seen.azimuth + place.north, seen.elevation});
    }
    return suns;
}

}  // namespace stereonav
