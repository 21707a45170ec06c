// Phase functions as tables over the angle. Between entries a weight is linear in the angle, so the means
// here are exact integrals of the table itself, not of the curve it was made from.
#include "engine/medium/model/phase_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr double kStep = kPi / PhaseFunction::kEntries;
constexpr float kMostAsymmetry = 0.999f;

// Integrals over interval i of sin (the share of the sphere, times 2) and of sin times the place in the
// interval, 0 to 1: with them the integral of what is linear is exact.
struct Moments {
    double whole, rising;
};
Moments sineMoments(int i) {
    const double a = i * kStep, b = (i + 1) * kStep;
    const double whole = 2 * std::sin(0.5 * (a + b)) * std::sin(0.5 * kStep);  // cos a - cos b
    return {whole, (std::sin(b) - std::sin(a)) / kStep - std::cos(b)};
}
const std::vector<Moments>& allSineMoments() {
    static const std::vector<Moments> moments = [] {
        std::vector<Moments> all;
        all.reserve(PhaseFunction::kEntries);
        for (int i = 0; i < PhaseFunction::kEntries; ++i) all.push_back(sineMoments(i));
        return all;
    }();
    return moments;
}
// Returns the moments of sin cos.
Moments cosineMoments(int i) {
    const double a = i * kStep, b = (i + 1) * kStep;
    const double whole = 0.5 * std::sin(a + b) * std::sin(kStep);  // (cos 2a - cos 2b) / 4
    return {whole, (std::sin(2 * b) - std::sin(2 * a)) / (8 * kStep) - std::cos(2 * b) / 4};
}

double integral(const Moments& m, double first, double last) {
    return first * m.whole + (last - first) * m.rising;
}

glm::dvec3 meanOf(const std::vector<glm::dvec3>& weights) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < PhaseFunction::kEntries; ++i)
        for (int c = 0; c < 3; ++c) sum[c] += integral(allSineMoments()[i], weights[i][c], weights[i + 1][c]);
    return 0.5 * sum;
}

// The phase function of Henyey and Greenstein 1941, of mean 1 up to a factor.
double henyeyGreensteinWeight(double g, double cosine) {
    return (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

void checkPoints(const std::vector<PhaseFunction::Point>& points, const std::string& source) {
    const auto fail = [&](std::size_t n, const std::string& problem) {
        throw Error(source, "point " + std::to_string(n + 1), problem,
                    "give lines \"angle_deg red green blue\" with angles rising from 0 to 180");
    };
    if (points.size() < 2)
        throw Error(source, "", fmt::format("expected at least two points, got {}", points.size()),
                    "give a weight for 0 and for 180 degrees");
    for (std::size_t n = 0; n < points.size(); ++n) {
        const double angle = points[n].angle_deg;
        if (n == 0 && angle != 0) fail(n, fmt::format("expected the angle 0, got {}", angle));
        if (n > 0 && !(angle > points[n - 1].angle_deg))
            fail(n, fmt::format("expected an angle above {}, got {}", points[n - 1].angle_deg, angle));
        if (!(angle <= 180) || (n + 1 == points.size() && angle != 180))
            fail(n, fmt::format("expected angles up to 180, got {}", angle));
        for (int c = 0; c < 3; ++c)
            if (!(points[n].weight[c] >= 0 && std::isfinite(points[n].weight[c])))
                fail(n, fmt::format("expected a weight of 0 or more, got {}", points[n].weight[c]));
    }
}

glm::dvec3 weightAt(const std::vector<PhaseFunction::Point>& points, double degrees) {
    const auto above =
        std::upper_bound(points.begin() + 1, points.end() - 1, degrees,
                         [](double angle, const PhaseFunction::Point& p) { return angle < p.angle_deg; });
    const PhaseFunction::Point &a = *(above - 1), &b = *above;
    const double share = std::clamp((degrees - a.angle_deg) / (b.angle_deg - a.angle_deg), 0.0, 1.0);
    return glm::mix(glm::dvec3(a.weight), glm::dvec3(b.weight), share);
}

}  // namespace

PhaseFunction::PhaseFunction() : mEntries(kEntries + 1, glm::vec3(1.0f)) {
    accumulate();
}

PhaseFunction::PhaseFunction(const std::vector<glm::dvec3>& weights) {
    const glm::dvec3 mean = meanOf(weights);
    for (const glm::dvec3& weight : weights) mEntries.push_back(weight / mean);
    mIsotropic =
        std::all_of(weights.begin(), weights.end(), [&](const glm::dvec3& w) { return w == weights[0]; });
    if (mIsotropic) mEntries.assign(kEntries + 1, glm::vec3(1.0f));
    accumulate();
}

void PhaseFunction::accumulate() {
    mCumulative.assign(kEntries + 1, glm::dvec3(0.0));
    for (int i = 0; i < kEntries; ++i)
        for (int c = 0; c < 3; ++c)
            mCumulative[i + 1][c] =
                mCumulative[i][c] + 0.5 * integral(allSineMoments()[i], mEntries[i][c], mEntries[i + 1][c]);
}

PhaseFunction PhaseFunction::henyeyGreenstein(const glm::vec3& g, const std::string& source) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(g[c]) <= kMostAsymmetry))
            throw Error(source, "",
                        fmt::format("expected an asymmetry from -{0} to {0}, got {1}", kMostAsymmetry, g[c]),
                        "0 scatters evenly, 0.9 mostly straight on");
    std::vector<glm::dvec3> weights(kEntries + 1);
    for (int i = 0; i <= kEntries; ++i)
        for (int c = 0; c < 3; ++c) weights[i][c] = henyeyGreensteinWeight(g[c], std::cos(i * kStep));
    return PhaseFunction(weights);
}

PhaseFunction PhaseFunction::table(const std::vector<Point>& points, const std::string& source) {
    checkPoints(points, source);
    std::vector<glm::dvec3> weights(kEntries + 1);
    for (int i = 0; i <= kEntries; ++i) weights[i] = weightAt(points, i * 180.0 / kEntries);
    const glm::dvec3 mean = meanOf(weights);
    for (int c = 0; c < 3; ++c)
        if (!(mean[c] > 0))
            throw Error(source, "",
                        fmt::format("expected light at some angle, found none in {}", c == 0   ? "red"
                                                                                      : c == 1 ? "green"
                                                                                               : "blue"),
                        "give one weight above 0 in each colour");
    return PhaseFunction(weights);
}

glm::vec3 PhaseFunction::at(float cosine) const {
    const double inside = cosine > -1.0f ? std::min(cosine, 1.0f) : -1.0f;
    const double place = std::acos(inside) / kStep;
    const int low = std::clamp(static_cast<int>(place), 0, kEntries - 1);
    const float share = static_cast<float>(std::clamp(place - low, 0.0, 1.0));
    return mEntries[low] * (1 - share) + mEntries[low + 1] * share;
}

glm::vec3 PhaseFunction::meanCosine() const {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kEntries; ++i)
        for (int c = 0; c < 3; ++c) sum[c] += integral(cosineMoments(i), mEntries[i][c], mEntries[i + 1][c]);
    return 0.5 * sum;
}

float PhaseFunction::sampleCosine(int channel, float u) const {
    const double sought = std::clamp(static_cast<double>(u), 0.0, 1.0) * mCumulative[kEntries][channel];
    const auto above = std::upper_bound(mCumulative.begin() + 1, mCumulative.end() - 1, sought,
                                        [&](double s, const glm::dvec3& sum) { return s < sum[channel]; });
    const int i = static_cast<int>(above - mCumulative.begin()) - 1;
    const double p = mEntries[i][channel], q = mEntries[i + 1][channel];
    const double from = mCumulative[i][channel], to = mCumulative[i + 1][channel];
    const double rest = to > from ? std::clamp((sought - from) / (to - from), 0.0, 1.0) : 0.0;
    // Within an interval the weight is all but linear in the cosine; p + (q - p) s integrates to a parabola.
    const double root = std::sqrt(p * p + (q * q - p * p) * rest);
    const double share = p + root > 0 ? rest * (p + q) / (p + root) : rest;
    const double a = std::cos(i * kStep), b = std::cos((i + 1) * kStep);
    return static_cast<float>(a + (b - a) * std::clamp(share, 0.0, 1.0));
}

}  // namespace stereonav
