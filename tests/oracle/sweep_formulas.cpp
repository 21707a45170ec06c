#include "tests/oracle/sweep_formulas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace stereonav {

glm::dvec2 tapLags(const SweepGeometry& geometry, double x, double y, double t) {
    const RayFan& fan = geometry.light;
    const glm::dvec2 across(fan.perX * glm::dot(fan.right, geometry.axis),
                            -fan.perY * glm::dot(fan.up, geometry.axis));
    if (fan.parallel) return -geometry.leaning / glm::dot(fan.forward, geometry.axis) * across;
    // Rays d at unit depth have gone (t - start) |d| / (d . axis): its slopes.
    const double u = fan.xMin + x * fan.perX, v = fan.yMax - y * fan.perY;
    const glm::dvec3 d = fan.forward + fan.right * u + fan.up * v;
    const double c = glm::dot(d, geometry.axis), length = glm::length(d);
    const glm::dvec2 longer(u * fan.perX / length, -v * fan.perY / length);
    return geometry.leaning * (t - geometry.lightStart) / c * (longer - length / c * across);
}

BlurTaps blurTaps(double offset_texels) {
    // Four taps at distance r, together of weight w, spread by w r^2 / 2 along each axis. On a circle they
    // are read bilinearly, which spreads by about 1/6 more.
    const double square = std::min(offset_texels * offset_texels, 1e12);
    return {std::sqrt(std::max(square - 1.0 / 3, 1.0)), std::min(square, 1.0)};
}

double tapTurn(int x, int y, int slab) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(y) * 0xd8163841u ^
                      static_cast<std::uint32_t>(slab) * 0xcb1ab31fu;
    h = (h ^ h >> 16) * 0x7feb352du;  // the finaliser lowbias32 of C. Wellons
    h = (h ^ h >> 15) * 0x846ca68bu;
    h ^= h >> 16;
    return (h >> 8) * (glm::half_pi<double>() / 16777216.0);
}

double meanTransmittance(double x) {
    return x > 0 ? -std::expm1(-x) / x : 1.0;
}

double slabShare(double eyeDepth, double lightDepth, bool forward) {
    if (!(eyeDepth > 0)) return 0;
    const double x = std::min(eyeDepth, 1e30), y = std::min(lightDepth, 1e30);  // keeps 0 * infinity away
    if (forward) return x * meanTransmittance(x + y);
    return x * std::exp(-std::min(x, y)) * meanTransmittance(std::abs(x - y));
}

}  // namespace stereonav
