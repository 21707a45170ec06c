#include "terrain/light/sun_and_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/luminance.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kReference = 45 * kDegree;  // elevation at which the light is white and of strength 1
// Extinction of the clear air above red, green and blue (about 620, 540 and 460 nm): Rayleigh's, and 0.05 of
// haze.
constexpr glm::dvec3 kExtinction(0.11, 0.15, 0.25);
constexpr float kDarkest = 0.25f;  // level light below which the exposure no longer follows
constexpr float kNight = 0.01f;    // share of the sky's light that never goes

// Relative air mass: Kasten and Young 1989, eq. 3; elevation in radians, at least -0.5 degrees.
double airMass(double elevation) {
    const double degrees = std::max(elevation / kDegree, -0.5);
    return 1 / (std::sin(std::max(elevation, 0.0)) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
}

// The clear sky's light on level ground against that at the reference elevation: a smooth guess between a
// third of the sun's full height and nothing 5.7 degrees below the horizon.
float skyStrength(double elevation) {
    const double rise = std::max(0.0, std::sin(elevation) + 0.1) / (std::sin(kReference) + 0.1);
    return std::max(kNight, static_cast<float>(std::pow(rise, 0.75)));
}

}  // namespace

SkyRadiance skyRadiance(const std::function<glm::vec3(const glm::dvec3&)>& radiance) {
    // Midpoints in the sine of elevation and in azimuth: equal solid angles.
    constexpr int kRings = 64, kAround = 256;
    constexpr int kCount = lightHarmonics(kMaxHarmonicsOrder);
    constexpr double kSolidAngle = 2 * std::numbers::pi / (double(kRings) * kAround);
    std::vector<glm::dvec3> sum(kCount, glm::dvec3(0.0));
    glm::dvec3 level(0.0);
    double values[kMaxHarmonics];
    for (int r = 0; r < kRings; ++r)
        for (int a = 0; a < kAround; ++a) {
            const double z = (r + 0.5) / kRings, across = std::sqrt(1 - z * z);
            const double phi = (a + 0.5) * 2 * std::numbers::pi / kAround;
            const glm::dvec3 d(across * std::cos(phi), across * std::sin(phi), z);
            const glm::dvec3 light(glm::max(radiance(d), glm::vec3(0.0f)));
            evaluateHarmonics(d, kMaxHarmonicsOrder, values);
            // Twice: the lower half has the same even coefficients.
            for (int n = 0; n < kCount; ++n) sum[n] += 2 * kSolidAngle * values[lightHarmonic(n)] * light;
            level += kSolidAngle * z / std::numbers::pi * light;
        }
    SkyRadiance sky;
    for (const glm::dvec3& s : sum) sky.harmonics.emplace_back(s);
    sky.level = glm::vec3(level);
    return sky;
}

SkyRadiance skyRadiance(const SkyMap& sky) {
    const int size = sky.map().width();
    return skyRadiance([&](const glm::dvec3& d) {
        const double scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
        const auto texel = [&](double p) {
            return std::clamp(static_cast<int>((p * scale + 1) * 0.5 * size), 0, size - 1);
        };
        return unpackColor(sky.map().at(texel(d.x), texel(d.y)));
    });
}

glm::dvec3 directionToSun(double azimuth, double elevation) {
    const double across = std::cos(elevation);
    return {across * std::sin(azimuth), across * std::cos(azimuth), std::sin(elevation)};
}

glm::vec3 SunAndSky::level() const {
    return sky.level + sun * static_cast<float>(std::max(0.0, toSun.z));
}

double sunUp(double sine, double radius) {
    return std::clamp(sine / (2 * std::sin(radius)) + 0.5, 0.0, 1.0);
}

SunAndSky sunAndSky(const TerrainLook& look, const SkyRadiance& sky) {
    SunAndSky light;
    light.toSun = directionToSun(look.sunAzimuth, look.sunElevation);
    const float brightness = luminance(sky.level);
    const float ambient = std::clamp(look.ambient, 0.0f, 1.0f);
    const glm::vec3 tint = brightness > 0 ? sky.level / brightness : glm::vec3(1.0f);
    // The sun gives what the sky's light lacks of white.
    const glm::vec3 sunLevel = glm::max(glm::vec3(1.0f) - ambient * tint, glm::vec3(0.0f));
    if (light.toSun.z > -std::sin(light.sunRadius)) {
        const double mass = airMass(look.sunElevation) - airMass(kReference);
        light.sunThroughAir = glm::vec3(glm::exp(-kExtinction * mass));
        light.sun = sunLevel / static_cast<float>(std::sin(kReference)) * light.sunThroughAir;
    }
    const float scale = ambient * skyStrength(look.sunElevation);
    light.sky.level = scale * tint;
    if (brightness > 0) {
        for (const glm::vec3& c : sky.harmonics) light.sky.harmonics.push_back(scale / brightness * c);
    } else {  // a black sky: uniform light in its place
        light.sky.harmonics.assign(lightHarmonics(kMaxHarmonicsOrder), glm::vec3(0.0f));
        light.sky.harmonics[0] = glm::vec3(scale * static_cast<float>(std::sqrt(4 * std::numbers::pi)));
    }
    return light;
}

float exposureOf(const SunAndSky& light) {
    return 1 / std::max(kDarkest, luminance(light.level()));
}

}  // namespace stereonav
