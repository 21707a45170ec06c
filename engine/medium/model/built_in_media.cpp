// The cloud and the wax block. Only sums, products and square roots: every machine makes the same voxels.
#include "engine/medium/model/built_in_media.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "engine/medium/model/sampled_field.h"

namespace stereonav {
namespace {

struct Ellipsoid {
    glm::dvec3 center, radii;  // metres
    double strength;
};

// A heap: a broad base, towers on it, small heads at their sides.
constexpr std::array<Ellipsoid, 14> kCloud{{
    {{-120, 0, 620}, {620, 480, 230}, 1.0},
    {{340, 60, 640}, {480, 400, 220}, 0.9},
    {{-480, -60, 640}, {360, 330, 190}, 0.8},
    {{-200, 40, 880}, {400, 360, 330}, 1.0},
    {{-60, -40, 1180}, {330, 310, 310}, 1.0},
    {{40, 20, 1440}, {230, 220, 200}, 0.9},
    {{300, -60, 920}, {300, 280, 260}, 0.9},
    {{380, 100, 1120}, {200, 190, 180}, 0.8},
    {{-440, 100, 900}, {240, 230, 220}, 0.8},
    {{-330, -120, 1180}, {190, 180, 170}, 0.8},
    {{120, -320, 800}, {280, 220, 210}, 0.8},
    {{60, 320, 860}, {270, 220, 230}, 0.8},
    {{-160, 240, 1200}, {190, 180, 170}, 0.7},
    {{620, -40, 700}, {220, 200, 150}, 0.7},
}};
constexpr double kCloudBase = 480;  // metres; below it droplets do not form

// Wyvill, McPheeters and Wyvill 1986 use a similar bump: 1 in the middle, 0 from the surface on, smooth.
double bump(const Ellipsoid& e, const glm::dvec3& world) {
    const glm::dvec3 d = (world - e.center) / e.radii;
    const double rest = 1 - glm::dot(d, d);
    return rest > 0 ? e.strength * rest * rest : 0.0;
}

double cloudValue(const glm::dvec3& world) {
    double sum = 0;
    for (const Ellipsoid& e : kCloud) sum += bump(e, world);
    const double base = std::clamp((world.z - kCloudBase) / 90, 0.0, 1.0);
    return 1.6 * kMostInField * sum * base;
}

// Signed distances, metres: negative inside.
double roundedBox(const glm::dvec3& p, const glm::dvec3& half, double radius) {
    const glm::dvec3 d = glm::abs(p) - (half - radius);
    return glm::length(glm::max(d, 0.0)) + std::min(std::max({d.x, d.y, d.z}), 0.0) - radius;
}

// 56 x 56 x 60 mm with a molten dish and the hole of a wick in its upper face, at z = 70 mm.
double waxDistance(const glm::dvec3& world) {
    const glm::dvec3 p = world - glm::dvec3(0, 0, 0.040);
    const double block = roundedBox(p, {0.028, 0.028, 0.030}, 0.004);
    const double dish = glm::length(p - glm::dvec3(0, 0, 0.055)) - 0.029;
    const double wick = std::max(glm::length(glm::dvec2(p.x, p.y)) - 0.0022, 0.006 - p.z);
    return std::max({block, -dish, -wick});
}

}  // namespace

std::shared_ptr<GreyVolume> makeCloudField() {
    return sampledField(64, 2000, {-1000, -1000, 0}, cloudValue);
}

Perturbation cloudPerturbation() {
    Perturbation p;
    p.seed = 7;
    // Scattered light is lost a little more in red here, in blue there: the iridescence of fig. 10.
    NoiseScale billows{2600, 190, 0, {}, {0.35f, 0, -0.35f}, {3, 1, 0.5}};
    NoiseScale heads{900, 75, 0, {}, {}, {-2, 1.5, 1}};
    NoiseScale wisps{310, 28, 0.35f, {}, {}, {1, -2, 1}};
    NoiseScale tufts{110, 10, 0.35f, {}, {}, {0.5, 1, -1}};
    p.scales = {billows, heads, wisps, tufts};
    return p;
}

std::shared_ptr<GreyVolume> makeWaxField() {
    constexpr double kBlur = 0.0015;  // metres from the surface to the ends of the values
    return sampledField(96, 0.080, {-0.040, -0.040, 0}, [](const glm::dvec3& world) {
        return kMostInField * (0.5 - 0.5 * waxDistance(world) / kBlur);
    });
}

}  // namespace stereonav
