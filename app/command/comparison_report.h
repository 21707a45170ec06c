// Results of `compare` as a table, JSON, CSV and a plot. Missing figures are NaN: shown as a dash, null or an
// empty cell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/camera/stereo_rig.h"
#include "engine/metrics/method_comparison.h"
#include "engine/scene/facts.h"

namespace stereonav {

struct ComparisonReport {
    std::string scene, path, machine, simd;
    int width = 0, height = 0;  // pixels of one eye
    int threads = 0, frames = 0, repeats = 0;
    int truthRays = 0;  // rays per pixel of the finer truths
    int edgeRays = 0;   // rays added at the edges of both eyes
    StereoSetting stereo;
    std::optional<Fact> curvature;  // for ground over a round Earth: factOfCurvature
    double least = 0;               // least separation, metres: eyes come together where a lumen is narrow
    std::vector<MethodFigures> methods;  // medians over the frames
};

std::string tableOf(const ComparisonReport& report);
std::string jsonOf(const ComparisonReport& report);
std::string csvOf(const ComparisonReport& report);
// Plots error against time, once for each truth.
Plane<PackedColor> plotOf(const ComparisonReport& report);

}  // namespace stereonav
