// Media and views with answers known in closed form, and the statistics that paths are held against them by.
#pragma once

#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "engine/math/constants.h"
#include "tests/support/track_picture.h"

namespace stereonav {

constexpr double kReference = 0.01;  // metres: opacity 1 - 1e-6 is 1381 / m
// Two-sided: a right estimate fails once in 16,000. Seeds are fixed, so tests pass or fail for good.
constexpr double kStated_z = 4.0;

inline MediumMaterial materialOf(double extinction, const glm::vec3& color, const glm::vec3& glow = {}) {
    MediumMaterial material;
    material.color = color;
    material.opacity = -std::expm1(-extinction * kReference);
    material.glow = glow;
    return material;
}

// A slab from z = -thickness to 0, 10,000 times as wide, between values 0 below and 1000 above.
inline std::shared_ptr<GreyVolume> slabField(double thickness, std::int16_t below, std::int16_t above) {
    VolumeFrame frame;
    frame.size = {2, 2, 2};
    const double wide = 1e4 * thickness;
    frame.spacing = {wide, wide, thickness};
    frame.origin = {-wide / 2, -wide / 2, -thickness};
    auto field = std::make_shared<GreyVolume>(frame);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            field->at(i, j, 0) = below;
            field->at(i, j, 1) = above;
        }
    return field;
}

inline Medium homogeneousSlab(double extinction, double thickness, const glm::vec3& color,
                              const glm::vec3& glow = {}) {
    const MediumMaterial material = materialOf(extinction, color, glow);
    const MediumTransfer transfer({{0, material}, {1000, material}}, kReference, "slab");
    return Medium(slabField(thickness, 500, 500), transfer);
}

// Extinction 0 at the top (z = 0), `most` at the bottom, linear between.
inline Medium rampSlab(double most, double thickness, const glm::vec3& color) {
    const MediumTransfer transfer({{0, materialOf(0, color)}, {1000, materialOf(most, color)}}, kReference,
                                  "ramp");
    return Medium(slabField(thickness, 1000, 0), transfer);
}

// Every pixel looks along `direction` through the middle of the slab's upper (or, from below, lower) face.
inline EyeView narrowView(const glm::dvec3& direction, double distance = 1, const glm::dvec3& at = {}) {
    EyeView view;
    view.forward = glm::normalize(direction);
    const glm::dvec3 any = std::abs(view.forward.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    view.right = glm::normalize(glm::cross(view.forward, any));
    view.up = glm::cross(view.right, view.forward);
    view.eye = at - distance * view.forward;
    view.head = view.eye;
    view.xMin = view.yMin = -1e-7;
    view.xMax = view.yMax = 1e-7;
    view.width = view.height = 8;
    view.nearDepth = 1e-3 * distance;
    return view;
}

inline MediumLook litLook(const glm::dvec3& direction, MediumModel model = MediumModel::Direct) {
    MediumLook look;
    look.model = model;
    look.light.direction = glm::normalize(direction);
    return look;
}

struct Estimate {
    glm::dvec3 light{0.0}, error{0.0};  // mean and its standard deviation
    double seen = 0;                    // background's share
    double z(int channel, double truth) const { return (light[channel] - truth) / error[channel]; }
};

// All pixels taken as one: for narrow views.
inline Estimate meanOf(const TrackedPicture& picture) {
    Estimate mean;
    glm::dvec3 variance{0.0};
    const double n = static_cast<double>(picture.light.width()) * picture.light.height();
    for (int y = 0; y < picture.light.height(); ++y)
        for (int x = 0; x < picture.light.width(); ++x) {
            mean.light += glm::dvec3(picture.light.at(x, y)) / n;
            mean.seen += picture.light.at(x, y).w / n;
            variance += glm::dvec3(picture.variance.at(x, y)) / (n * n);
        }
    mean.error = glm::sqrt(variance);
    return mean;
}

inline Estimate track(const Medium& medium, const MediumLook& look, const EyeView& view, int samples,
                      int mostScatters = 1, std::uint32_t seed = 1) {
    TrackingSetting setting;
    setting.samples = samples;
    setting.mostScatters = mostScatters;
    setting.seed = seed;
    return meanOf(trackPicture(medium, look, view, setting));
}

// Nodes and weights of Gauss and Legendre's rule on [0, 1], by Newton's method.
struct Node {
    double at, weight;
};
inline std::vector<Node> gaussNodes(int count) {
    std::vector<Node> nodes;
    for (int i = 0; i < count; ++i) {
        double x = std::cos(kPi * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < 50; ++step) {
            double p = 1, before = 0;
            for (int n = 1; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
                before = p;
                p = next;
            }
            slope = count * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
    }
    return nodes;
}

}  // namespace stereonav
