// How far pictures of a medium are from the paths' truth, and how far that is from itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/stopwatch.h"
#include "engine/image/packed_color.h"
#include "engine/medium/model/medium_picture.h"
#include "tests/support/track_picture.h"

namespace stereonav::bench {

constexpr int kMostScatters = 4096;  // roulette ends paths long before

// Two pictures of half the samples each. Their difference says how noisy their mean is, and products of
// both errors of a picture have the mean of its error's square without their noise.
struct MediumTruth {
    Plane<glm::vec4> one, two;
    double linearNoise = 0, displayNoise = 0;  // the mean's noise: RMS of pixels and channels
    double seconds = 0;
};

inline glm::vec3 shown(const glm::vec4& light, const glm::vec3& background) {
    const glm::vec3 linear =
        glm::clamp(glm::vec3(light) + light.w * background, glm::vec3(0.0f), glm::vec3(1.0f));
    return {srgbFromLinear(linear.x), srgbFromLinear(linear.y), srgbFromLinear(linear.z)};
}

// Errors against the truth without its noise, at least what can be told from it.
struct MediumError {
    double linear = 0;   // RMSE of light with its background
    double display = 0;  // RMSE of what a display is given, sRGB-coded, clipped to 0..1
    double light = 0;    // sum of light over the truth's
    bool lost = false;   // below what can be told: `linear` and `display` are bounds
    double psnr_db() const { return display > 0 ? -20 * std::log10(display) : 100; }
};

// Products of two halves' noise, each sqrt(2) times that of their mean, have a mean of 0 and over `count`
// numbers a standard deviation of 2 noise^2 / sqrt(count); twice that is taken for an error.
inline double leastError(double noise, double count) {
    return 2 * noise / std::pow(count, 0.25);
}

// The mean over pixels and channels of the products of a picture's differences from two others.
struct ErrorProducts {
    double linear = 0, display = 0;
};
inline ErrorProducts errorProducts(const Plane<glm::vec4>& one, const Plane<glm::vec4>& two,
                                   const Plane<glm::vec4>& picture, const glm::vec3& background) {
    ErrorProducts sum;
    const double count = 3.0 * picture.width() * picture.height();
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const glm::vec4 p = picture.at(x, y), a = p - one.at(x, y), b = p - two.at(x, y);
            const glm::vec3 s = shown(p, background);
            sum.linear += glm::dot(glm::dvec3(glm::vec3(a) + a.w * background),
                                   glm::dvec3(glm::vec3(b) + b.w * background)) /
                          count;
            sum.display += glm::dot(glm::dvec3(s - shown(one.at(x, y), background)),
                                    glm::dvec3(s - shown(two.at(x, y), background))) /
                           count;
        }
    return sum;
}

inline glm::dvec3 sumOf(const Plane<glm::vec4>& light) {
    glm::dvec3 sum{0.0};
    for (int y = 0; y < light.height(); ++y)
        for (int x = 0; x < light.width(); ++x) sum += glm::dvec3(light.at(x, y));
    return sum;
}

inline MediumError errorOf(const MediumTruth& truth, const Plane<glm::vec4>& picture,
                           const glm::vec3& background) {
    const ErrorProducts products = errorProducts(truth.one, truth.two, picture, background);
    const glm::dvec3 there = 0.5 * (sumOf(truth.one) + sumOf(truth.two)), here = sumOf(picture);
    const double count = 3.0 * picture.width() * picture.height();
    const double least = leastError(truth.linearNoise, count);
    MediumError error;
    error.lost = products.linear < least * least;
    error.linear = std::sqrt(std::max(least * least, products.linear));
    error.display =
        std::max(leastError(truth.displayNoise, count), std::sqrt(std::max(0.0, products.display)));
    error.light = (here.x + here.y + here.z) / std::max(there.x + there.y + there.z, 1e-300);
    return error;
}

// Mean absolute difference of what a display is given, in grey levels of 255.
inline double greyLevels(const Plane<glm::vec4>& one, const Plane<glm::vec4>& two,
                         const glm::vec3& background) {
    double sum = 0;
    for (int y = 0; y < one.height(); ++y)
        for (int x = 0; x < one.width(); ++x) {
            const glm::vec3 d = glm::abs(shown(one.at(x, y), background) - shown(two.at(x, y), background));
            sum += d.x + d.y + d.z;
        }
    return 255 * sum / (3.0 * one.width() * one.height());
}

inline MediumTruth trackTruth(const Medium& medium, const MediumLook& look, const EyeView& view, int samples,
                              double time) {
    const Stopwatch watch;
    TrackingSetting setting;
    setting.samples = std::max(1, samples / 2);
    setting.mostScatters = kMostScatters;
    MediumTruth truth;
    truth.one = trackPicture(medium, look, view, setting, time).light;
    setting.seed = 2;
    truth.two = trackPicture(medium, look, view, setting, time).light;
    const ErrorProducts between = errorProducts(truth.one, truth.one, truth.two, look.background);
    truth.linearNoise = std::sqrt(between.linear) / 2;
    truth.displayNoise = std::sqrt(between.display) / 2;
    truth.seconds = watch.elapsed_ms() / 1000;
    return truth;
}

// Shares of all the truth's light: what is scattered once, what could be carried by light that never turns
// back, and the rest.
struct OrderShares {
    glm::dvec3 direct{0.0}, forward{0.0};
};
inline OrderShares orderShares(const Medium& medium, const MediumLook& look, const EyeView& view, int samples,
                               double time) {
    TrackingSetting setting;
    setting.samples = samples;
    setting.mostScatters = kMostScatters;
    const glm::dvec3 all = glm::max(sumOf(trackPicture(medium, look, view, setting, time).light), 1e-300);
    setting.onlyForward = true;
    const glm::dvec3 forward = sumOf(trackPicture(medium, look, view, setting, time).light);
    setting.mostScatters = 1;
    return {sumOf(trackPicture(medium, look, view, setting, time).light) / all, forward / all};
}

}  // namespace stereonav::bench
