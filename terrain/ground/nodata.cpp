// Holes filled in two steps: a pyramid of averages gives a first guess (push-pull, Gortler et al., The
// Lumigraph, 1996), then the membrane solver makes it exact.
#include "terrain/ground/nodata.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/memory.h"
#include "terrain/ground/membrane.h"

namespace stereonav {
namespace {

// Beyond this many missing samples (0.9 GB in the solver) the pyramid's guess stays as it is.
constexpr std::size_t kMostSolved = 10'000'000;
constexpr double kSolverBytes = 130;  // a missing sample, all levels

struct FillLevel {
    int width, height;
    std::vector<float> values;  // NaN: unknown
    float at(int i, int j) const { return values[static_cast<std::size_t>(j) * width + i]; }
};

FillLevel averaged(const FillLevel& fine) {
    FillLevel coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    coarse.values.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
    for (int j = 0; j < coarse.height; ++j)
        for (int i = 0; i < coarse.width; ++i) {
            double sum = 0;
            int known = 0;
            for (int b = 2 * j; b < std::min(2 * j + 2, fine.height); ++b)
                for (int a = 2 * i; a < std::min(2 * i + 2, fine.width); ++a)
                    if (const float h = fine.at(a, b); std::isfinite(h)) {
                        sum += h;
                        ++known;
                    }
            coarse.values.push_back(known ? static_cast<float>(sum / known) : NAN);
        }
    return coarse;
}

// Returns a bilinear mean between the centres of the coarse samples; clamped at the border.
float between(const FillLevel& coarse, int fineI, int fineJ) {
    const double x = std::clamp(0.5 * fineI - 0.25, 0.0, coarse.width - 1.0);
    const double y = std::clamp(0.5 * fineJ - 0.25, 0.0, coarse.height - 1.0);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const int i1 = std::min(i + 1, coarse.width - 1), j1 = std::min(j + 1, coarse.height - 1);
    const double u = x - i, v = y - j;
    return static_cast<float>((1 - v) * ((1 - u) * coarse.at(i, j) + u * coarse.at(i1, j)) +
                              v * ((1 - u) * coarse.at(i, j1) + u * coarse.at(i1, j1)));
}

void fillFromPyramid(FillLevel& finest) {
    std::vector<FillLevel> coarser;
    const FillLevel* level = &finest;
    while (
        std::any_of(level->values.begin(), level->values.end(), [](float h) { return !std::isfinite(h); })) {
        coarser.push_back(averaged(*level));
        level = &coarser.back();
    }
    for (int k = static_cast<int>(coarser.size()) - 1; k >= 0; --k) {
        FillLevel& fine = k > 0 ? coarser[k - 1] : finest;
        for (int j = 0; j < fine.height; ++j)
            for (int i = 0; i < fine.width; ++i)
                if (float& h = fine.values[static_cast<std::size_t>(j) * fine.width + i]; !std::isfinite(h))
                    h = between(coarser[k], i, j);
    }
}

}  // namespace

long long countMissing(const std::vector<float>& heights) {
    return std::count_if(heights.begin(), heights.end(), [](float h) { return !std::isfinite(h); });
}

void guessMissing(std::vector<float>& heights, int width, int height) {
    if (countMissing(heights) == static_cast<long long>(heights.size())) return;
    FillLevel finest{width, height, std::move(heights)};
    fillFromPyramid(finest);
    heights = std::move(finest.values);
}

long long fillMissing(std::vector<float>& heights, int width, int height, const glm::dvec2& spacing,
                      Progress& progress) {
    constexpr const char* kFilling = "filling missing samples";
    progress.report(0, kFilling);
    const auto missingCount = static_cast<std::size_t>(countMissing(heights));
    if (missingCount == 0 || missingCount == heights.size()) {
        progress.report(1, kFilling);
        return 0;
    }
    const double solved = missingCount <= kMostSolved ? kSolverBytes * static_cast<double>(missingCount) : 0;
    const double guess = 1.4 * sizeof(float) * static_cast<double>(heights.size());  // a pyramid of them
    checkMemory(fmt::format("filling {} missing samples", missingCount),
                std::max(solved, guess) + sizeof(std::size_t) * static_cast<double>(missingCount),
                "leave them open with --open-holes, or cut out a part");
    std::vector<std::size_t> missing;
    missing.reserve(missingCount);
    for (std::size_t k = 0; k < heights.size(); ++k)
        if (!std::isfinite(heights[k])) missing.push_back(k);
    guessMissing(heights, width, height);
    if (missing.size() <= kMostSolved) solveMembrane(missing, heights, width, height, spacing, progress);
    progress.report(1, kFilling);
    return static_cast<long long>(missing.size());
}

}  // namespace stereonav
