// Preetham et al. 1999: the sky's luminance and chromaticity by Perez's distribution (eq. 3 and 4,
// coefficients of appendix A.2), the sun's light dimmed by the air (appendix A.1). Differs in the sun's
// spectrum: three wavelengths stand for red, green and blue, the light above the air is white, and of the air
// only molecules and haze count, not ozone, mixed gases and water vapour.
#include "engine/light/skies/sky_probe.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/math/luminance.h"

namespace stereonav {
namespace {

constexpr double kSunRadius = 0.5 * 0.533 * kPi / 180;  // at the mean distance
constexpr double kSunAboveTheAir_klx = 128;             // across the rays
const glm::dvec3 kWavelengths_um(0.61, 0.55, 0.465);

void require(bool fits, const char* name, const std::string& expected) {
    if (!fits) throw Error("", std::string("sky, ") + name, "expected " + expected, "give another value");
}

void checkGround(double albedo, int height) {
    require(albedo >= 0 && albedo <= 1, "ground", "an albedo of 0 to 1");
    require(height >= 2 && height <= 4096 && height % 2 == 0, "height", "an even number of rows, 2 to 4096");
}

// Perez's distribution.
struct Perez {
    double a, b, c, d, e;

    double operator()(double cosZenith, double cosSun) const {
        const double sun = std::acos(std::clamp(cosSun, -1.0, 1.0));
        return (1 + a * std::exp(b / std::max(cosZenith, 1e-3))) *
               (1 + c * std::exp(d * sun) + e * cosSun * cosSun);
    }
};

// One of Y, x and y: its value at the zenith, spread by the distribution.
struct Distribution {
    Perez perez;
    double factor;  // value at the zenith over the distribution there

    Distribution(const Perez& p, double zenith, double cosSun) : perez(p), factor(zenith / p(1, cosSun)) {}
    double at(double cosZenith, double cosSun) const { return factor * perez(cosZenith, cosSun); }
};

double polynomial(const double (&rows)[3][4], double turbidity, double angle) {
    const double powers[3] = {turbidity * turbidity, turbidity, 1};
    double sum = 0;
    for (int r = 0; r < 3; ++r)
        sum += powers[r] * (((rows[r][0] * angle + rows[r][1]) * angle + rows[r][2]) * angle + rows[r][3]);
    return sum;
}

// Radiance of the sky (kcd/m^2 where it is luminance), linear RGB of sRGB's primaries.
class PreethamSky {
public:
    PreethamSky(const glm::dvec3& sun, double t)
        : mSun(sun),
          mLuminance({0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                      -0.0670 * t + 0.3703},
                     zenithLuminance(t), sun.z),
          mX({-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
              -0.0033 * t + 0.0452},
             polynomial(kZenithX, t, std::acos(sun.z)), sun.z),
          mY({-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
              -0.0109 * t + 0.0529},
             polynomial(kZenithY, t, std::acos(sun.z)), sun.z) {}

    // w: unit, above the horizon. Colours beyond the primaries are cut off at 0.
    glm::dvec3 radiance(const glm::dvec3& w) const {
        const double cosSun = glm::dot(w, mSun);
        const double luminance = std::max(0.0, mLuminance.at(w.z, cosSun));
        const double x = mX.at(w.z, cosSun), y = std::max(1e-3, mY.at(w.z, cosSun));
        const glm::dvec3 xyz = luminance * glm::dvec3(x / y, 1, (1 - x - y) / y);
        static const glm::dmat3 kRgbFromXyz(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986,
                                            0.0415, 1.0570);
        return glm::max(kRgbFromXyz * xyz, glm::dvec3(0.0));
    }

private:
    double zenithLuminance(double t) const {
        const double angle = (4.0 / 9.0 - t / 120.0) * (kPi - 2 * std::acos(mSun.z));
        return (4.0453 * t - 4.9710) * std::tan(angle) - 0.2155 * t + 2.4192;
    }

    static constexpr double kZenithX[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                              {-0.02903, 0.06377, -0.03202, 0.00394},
                                              {0.11693, -0.21196, 0.06052, 0.25886}};
    static constexpr double kZenithY[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                              {-0.04214, 0.08970, -0.04153, 0.00516},
                                              {0.15346, -0.26756, 0.06670, 0.26688}};
    glm::dvec3 mSun;
    Distribution mLuminance, mX, mY;
};

// Returns the part of the sun's light that arrives, across its rays (klx where it is illuminance): Rayleigh's
// and Angstrom's scattering along the air mass.
glm::dvec3 sunlight(double cosZenith, double turbidity) {
    const double zenith_deg = std::acos(cosZenith) * 180 / kPi;
    const double airMass = 1 / (cosZenith + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
    const double haze = 0.04608 * turbidity - 0.04586;
    glm::dvec3 light;
    for (int c = 0; c < 3; ++c) {
        const double depth =
            0.008735 * std::pow(kWavelengths_um[c], -4.08) + haze * std::pow(kWavelengths_um[c], -1.3);
        light[c] = kSunAboveTheAir_klx * std::exp(-depth * airMass);
    }
    return light;
}

// A picture of the sphere while it is painted.
struct Panorama {
    int height;
    std::vector<glm::dvec3> pixels;

    explicit Panorama(int rows) : height(rows), pixels(static_cast<std::size_t>(rows) * rows * 2) {}

    double edge(int row) const { return std::cos(kPi * row / height); }
    double solidAngle(int row) const { return kPi / height * (edge(row) - edge(row + 1)); }
    glm::dvec3& at(int column, int row) {
        return pixels[static_cast<std::size_t>(row) * height * 2 + column];
    }

    // Middle of a pixel: of its solid angle, so that what is linear in height is painted exactly.
    glm::dvec3 direction(int column, int row) const {
        const double z = 0.5 * (edge(row) + edge(row + 1)), radius = std::sqrt(1 - z * z);
        const double azimuth = kPi * ((column + 0.5) / height - 1);
        return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
    }
    // Light of a narrow source, across its rays, into the pixel that holds its direction.
    void addSource(const glm::dvec3& w, const glm::dvec3& light) {
        const double polar = std::acos(std::clamp(w.z, -1.0, 1.0));
        const double azimuth = std::atan2(w.y, w.x);
        const int row = std::min(height - 1, static_cast<int>(polar / kPi * height));
        const int column = std::min(2 * height - 1, static_cast<int>((azimuth / kPi + 1) * height));
        at(column, row) += light / solidAngle(row);
    }
    // Returns the light that falls on a horizontal surface from above.
    glm::dvec3 irradiance() {
        glm::dvec3 sum(0.0);
        for (int row = 0; row < height / 2; ++row)
            for (int column = 0; column < 2 * height; ++column)
                sum += at(column, row) * (solidAngle(row) * direction(column, row).z);
        return sum;
    }
};

// The disc as points that are spread evenly over it (by the golden angle); what has set is not added.
void addSun(Panorama& panorama, const glm::dvec3& sun, const glm::dvec3& light) {
    constexpr int kPoints = 1024;
    const glm::dvec3 helper = std::abs(sun.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, sun)), v = glm::cross(sun, u);
    for (int n = 0; n < kPoints; ++n) {
        const double radius = kSunRadius * std::sqrt((n + 0.5) / kPoints);
        const double angle = n * kPi * (3 - std::sqrt(5.0));
        const glm::dvec3 w =
            glm::normalize(sun + std::tan(radius) * (std::cos(angle) * u + std::sin(angle) * v));
        if (w.z > 0) panorama.addSource(w, light / static_cast<double>(kPoints));
    }
}

LightProbe finished(Panorama panorama, double groundAlbedo, const std::string& name) {
    const glm::dvec3 white = panorama.irradiance() / kPi;  // what a white surface sends out
    const double scale = 1 / luminance(white);
    const glm::dvec3 ground = groundAlbedo * white;
    std::vector<glm::vec3> pixels;
    pixels.reserve(panorama.pixels.size());
    for (std::size_t n = 0; n < panorama.pixels.size(); ++n)
        pixels.push_back(glm::vec3(scale * (n < panorama.pixels.size() / 2 ? panorama.pixels[n] : ground)));
    return LightProbe(2 * panorama.height, panorama.height, std::move(pixels), name);
}

}  // namespace

LightProbe clearSkyProbe(const ClearSky& sky) {
    checkGround(sky.groundAlbedo, sky.height);
    require(sky.turbidity >= 1.8 && sky.turbidity <= 10, "turbidity", "1.8 to 10");
    const double length = glm::length(sky.sun);
    require(length > 0 && std::isfinite(length), "sun", "a direction");
    const glm::dvec3 sun = sky.sun / length;
    require(sun.z >= 0, "sun", "a direction at or above the horizon");
    const PreethamSky model(sun, sky.turbidity);
    Panorama panorama(sky.height);
    for (int row = 0; row < sky.height / 2; ++row)
        for (int column = 0; column < 2 * sky.height; ++column)
            panorama.at(column, row) = model.radiance(panorama.direction(column, row));
    if (sky.disc) addSun(panorama, sun, sunlight(sun.z, sky.turbidity));
    return finished(std::move(panorama), sky.groundAlbedo, "clear sky");
}

LightProbe overcastSkyProbe(double groundAlbedo, int height) {
    checkGround(groundAlbedo, height);
    Panorama panorama(height);
    for (int row = 0; row < height / 2; ++row)
        for (int column = 0; column < 2 * height; ++column)
            panorama.at(column, row) = glm::dvec3((1 + 2 * panorama.direction(column, row).z) / 3);
    return finished(std::move(panorama), groundAlbedo, "overcast sky");
}

}  // namespace stereonav
