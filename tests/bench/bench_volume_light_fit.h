// How the model's free settings follow the truth of multiple scattering: extinction of scattered light, the
// blur's cone, and the share of scattered light, which is linear and so found by least squares.
#pragma once

#include <array>
#include <cstdio>
#include <glm/exponential.hpp>
#include <limits>

#include "tests/bench/bench_volume_light_errors.h"
#include "tests/bench/bench_volume_light_runs.h"
#include "tests/bench/bench_volume_light_subjects.h"

namespace stereonav::bench {

// The same medium with scattered light's extinction a factor of tau; factor < 0: as the file has it.
inline MediumTransfer withIndirect(const MediumTransfer& transfer,
                                   const std::function<glm::dvec3(const glm::vec3& color)>& factor) {
    std::vector<MediumPoint> points = transfer.points();
    for (MediumPoint& p : points) {
        const glm::dvec3 f = factor(p.material.color);
        const double depth = -std::log1p(-std::min(p.material.opacity, MediumTransfer::kDensest));
        for (int c = 0; c < 3; ++c) p.material.transport[c] = static_cast<float>(std::exp(-f[c] * depth));
    }
    return MediumTransfer(points, transfer.referenceLength(), "with other indirect extinction");
}

struct IndirectRule {
    std::string name;
    std::function<glm::dvec3(const glm::vec3& color)> factor;  // factor on tau; empty: the preset's own
};
inline std::vector<IndirectRule> indirectRules() {
    std::vector<IndirectRule> rules{{"preset", {}}};
    rules.push_back({"sqrt(3(1-a))", [](const glm::vec3& color) {
                         return glm::sqrt(3.0 * (1.0 - glm::dvec3(glm::clamp(color, 0.0f, 1.0f))));
                     }});
    for (const double f : {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 1.0})
        rules.push_back({std::to_string(f).substr(0, 4), [f](const glm::vec3&) { return glm::dvec3(f); }});
    return rules;
}

// The picture at share q is direct + q * scattered: the q of least squares, by colour and for all together.
struct ShareFit {
    glm::dvec3 shares{0.0};
    double share = 0;        // one for all colours
    double byColor = 0;      // RMSE with `shares`
    double linear = 0;       // with `share`
    double linearAtOne = 0;  // with 1
};
// Sums of products with the truth's halves, so that its noise does not count as the model's error.
struct ShareSums {
    double dd = 0, de = 0, ee = 0, count = 0;
    void add(double scattered, double wantedOne, double wantedTwo) {
        dd += scattered * scattered;
        de += scattered * 0.5 * (wantedOne + wantedTwo);
        ee += wantedOne * wantedTwo;
        ++count;
    }
    double share() const { return dd > 0 ? std::max(0.0, de / dd) : 0; }
    double squares(double q) const { return std::max(0.0, ee - 2 * q * de + q * q * dd); }
};
inline ShareFit fitShare(const MediumTruth& truth, const Plane<glm::vec4>& direct,
                         const Plane<glm::vec4>& both) {
    std::array<ShareSums, 3> colors;
    ShareSums all;
    for (int y = 0; y < direct.height(); ++y)
        for (int x = 0; x < direct.width(); ++x)
            for (int c = 0; c < 3; ++c) {
                const double once = direct.at(x, y)[c], scattered = both.at(x, y)[c] - once;
                const double one = truth.one.at(x, y)[c] - once, two = truth.two.at(x, y)[c] - once;
                colors[c].add(scattered, one, two);
                all.add(scattered, one, two);
            }
    ShareFit fit;
    fit.share = all.share();
    fit.linear = std::sqrt(all.squares(fit.share) / all.count);
    fit.linearAtOne = std::sqrt(all.squares(1) / all.count);
    double squares = 0;
    for (int c = 0; c < 3; ++c) {
        fit.shares[c] = colors[c].share();
        squares += colors[c].squares(fit.shares[c]);
    }
    fit.byColor = std::sqrt(squares / all.count);
    return fit;
}

// The cone with the least RMSE among several, by one of the ways to choose the share.
struct FittedCone {
    double cone = 0, linear = std::numeric_limits<double>::infinity();
    ShareFit fit;
    void take(double itsCone, const ShareFit& its, double error) {
        if (error < linear) *this = {itsCone, error, its};
    }
};

inline void printFit(const MediumSubject& subject, const MediumLook& look, const MediumTruth& truth,
                     const EyeView& view) {
    std::printf(
        "| extinction of scattered light / tau | share 1: RMSE, cone | best share: RMSE, cone, share | "
        "share by colour: RMSE, cone, shares |\n|---|---|---|---|\n");
    for (const IndirectRule& rule : indirectRules()) {
        MediumSubject changed = subject;
        if (rule.factor) changed.transfer = withIndirect(subject.transfer, rule.factor);
        const Medium medium = changed.medium();
        const SweepPath path = cpuPath(medium);
        MediumLook directLook = look;
        directLook.model = MediumModel::Direct;
        SweepSetting setting;
        const OneEye direct = renderOne(path, directLook, setting, view, subject.time, 1);
        FittedCone one, free, byColor;
        for (const double cone : {0.0, 0.6, 1.2, 2.0}) {
            setting.coneAngle = cone;
            const OneEye both = renderOne(path, look, setting, view, subject.time, 1);
            const ShareFit fit = fitShare(truth, direct.picture.light, both.picture.light);
            one.take(cone, fit, fit.linearAtOne);
            free.take(cone, fit, fit.linear);
            byColor.take(cone, fit, fit.byColor);
        }
        const glm::dvec3& q = byColor.fit.shares;
        std::printf("| %s | %.4f, %.1f | %.4f, %.1f, %.2f | %.4f, %.1f, %.2f %.2f %.2f |\n",
                    rule.name.c_str(), one.linear, one.cone, free.linear, free.cone, free.fit.share,
                    byColor.linear, byColor.cone, q.x, q.y, q.z);
        std::fflush(stdout);
    }
}

}  // namespace stereonav::bench
