// Holes filled in two steps: a pyramid of averages gives a first guess (push-pull, Gortler et al.
// 1996, section 3.4), then conjugate gradients solve Laplace's equation over the missing samples
// alone. The guess takes away the long waves that conjugate gradients are slow at.
#include "terrain/nodata.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace stereonav {
namespace {

// Beyond this many missing samples (1.3 GB of vectors) the pyramid's guess stays as it is.
constexpr std::size_t kMostSolved = 30'000'000;
constexpr int kMostIterations = 2000;
constexpr double kMostWork = 4e9;        // missing samples times iterations: half a minute
constexpr double kRelativeError = 1e-6;  // of the residual against that of the guess

struct Level {
    int width, height;
    std::vector<float> values;  // NaN: unknown
    float at(int i, int j) const { return values[static_cast<std::size_t>(j) * width + i]; }
};

Level averaged(const Level& fine) {
    Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
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

// Bilinear between the centres of the coarse samples; clamped at the border.
float between(const Level& coarse, int fineI, int fineJ) {
    const double x = std::clamp(0.5 * fineI - 0.25, 0.0, coarse.width - 1.0);
    const double y = std::clamp(0.5 * fineJ - 0.25, 0.0, coarse.height - 1.0);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const int i1 = std::min(i + 1, coarse.width - 1), j1 = std::min(j + 1, coarse.height - 1);
    const double u = x - i, v = y - j;
    return static_cast<float>((1 - v) * ((1 - u) * coarse.at(i, j) + u * coarse.at(i1, j)) +
                              v * ((1 - u) * coarse.at(i, j1) + u * coarse.at(i1, j1)));
}

void fillFromPyramid(Level& finest) {
    std::vector<Level> coarser;
    const Level* level = &finest;
    while (
        std::any_of(level->values.begin(), level->values.end(), [](float h) { return !std::isfinite(h); })) {
        coarser.push_back(averaged(*level));
        level = &coarser.back();
    }
    for (int k = static_cast<int>(coarser.size()) - 1; k >= 0; --k) {
        Level& fine = k > 0 ? coarser[k - 1] : finest;
        for (int j = 0; j < fine.height; ++j)
            for (int i = 0; i < fine.width; ++i)
                if (float& h = fine.values[static_cast<std::size_t>(j) * fine.width + i]; !std::isfinite(h))
                    h = between(coarser[k], i, j);
    }
}

// The five-point Laplacian over the missing samples. A neighbour is an index into them, kKnown for a
// fixed sample (its weight stays on the diagonal) or kOutside beyond the grid (no weight at all).
class Laplacian {
public:
    static constexpr std::int32_t kKnown = -1, kOutside = -2;

    Laplacian(const std::vector<std::size_t>& missing, int width, int height, const glm::dvec2& spacing) {
        const double x = 1 / (spacing.x * spacing.x), y = 1 / (spacing.y * spacing.y), most = std::max(x, y);
        mWeights = {x / most, x / most, y / most, y / most};
        mNeighbors.reserve(missing.size());
        const std::size_t w = static_cast<std::size_t>(width);
        for (const std::size_t cell : missing) {
            const std::size_t i = cell % w, j = cell / w;
            mNeighbors.push_back(
                {i > 0 ? find(missing, cell - 1) : kOutside, i + 1 < w ? find(missing, cell + 1) : kOutside,
                 j > 0 ? find(missing, cell - w) : kOutside,
                 j + 1 < static_cast<std::size_t>(height) ? find(missing, cell + w) : kOutside});
        }
    }

    void apply(const std::vector<double>& in, std::vector<double>& out) const {
        for (std::size_t k = 0; k < in.size(); ++k) {
            double sum = 0;
            for (int n = 0; n < 4; ++n) {
                const std::int32_t other = mNeighbors[k][n];
                if (other == kOutside) continue;
                sum += mWeights[n] * (in[k] - (other >= 0 ? in[other] : 0.0));
            }
            out[k] = sum;
        }
    }

    const std::array<std::int32_t, 4>& neighbors(std::size_t k) const { return mNeighbors[k]; }
    double weight(int n) const { return mWeights[n]; }

private:
    static std::int32_t find(const std::vector<std::size_t>& missing, std::size_t cell) {
        const auto place = std::lower_bound(missing.begin(), missing.end(), cell);
        if (place == missing.end() || *place != cell) return kKnown;
        return static_cast<std::int32_t>(place - missing.begin());
    }

    std::array<double, 4> mWeights{};
    std::vector<std::array<std::int32_t, 4>> mNeighbors;
};

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

// Residual of the guess: what the known samples pull, less what the guess answers.
std::vector<double> residualOf(const Laplacian& laplacian, const std::vector<std::size_t>& missing,
                               const std::vector<float>& heights, int width) {
    const std::ptrdiff_t step[4] = {-1, 1, -static_cast<std::ptrdiff_t>(width), width};
    std::vector<double> residual(missing.size());
    for (std::size_t k = 0; k < missing.size(); ++k)
        for (int n = 0; n < 4; ++n)
            if (laplacian.neighbors(k)[n] != Laplacian::kOutside)
                residual[k] +=
                    laplacian.weight(n) * (double(heights[missing[k] + step[n]]) - heights[missing[k]]);
    return residual;
}

// Conjugate gradients for the correction to the guess.
void relax(const std::vector<std::size_t>& missing, std::vector<float>& heights, int width, int height,
           const glm::dvec2& spacing, Progress& progress) {
    const Laplacian laplacian(missing, width, height, spacing);
    std::vector<double> r = residualOf(laplacian, missing, heights, width), p = r;
    std::vector<double> x(r.size(), 0.0), ap(r.size());
    const int most =
        static_cast<int>(std::clamp(kMostWork / double(missing.size()), 20.0, double(kMostIterations)));
    double rr = dot(r, r);
    const double enough = rr * kRelativeError * kRelativeError;
    for (int iteration = 0; iteration < most && rr > enough; ++iteration) {
        if (iteration % 16 == 0) progress.report(double(iteration) / most, "filling missing samples");
        laplacian.apply(p, ap);
        const double step = rr / dot(p, ap);
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] += step * p[k];
            r[k] -= step * ap[k];
        }
        const double next = dot(r, r), turn = next / rr;
        rr = next;
        for (std::size_t k = 0; k < p.size(); ++k) p[k] = r[k] + turn * p[k];
    }
    for (std::size_t k = 0; k < missing.size(); ++k) heights[missing[k]] += static_cast<float>(x[k]);
}

}  // namespace

long long countMissing(const std::vector<float>& heights) {
    return std::count_if(heights.begin(), heights.end(), [](float h) { return !std::isfinite(h); });
}

long long fillMissing(std::vector<float>& heights, int width, int height, const glm::dvec2& spacing,
                      Progress& progress) {
    const auto missingCount = static_cast<std::size_t>(countMissing(heights));
    if (missingCount == 0 || missingCount == heights.size()) return 0;
    std::vector<std::size_t> missing;
    missing.reserve(missingCount);
    for (std::size_t k = 0; k < heights.size(); ++k)
        if (!std::isfinite(heights[k])) missing.push_back(k);
    Level finest{width, height, std::move(heights)};
    fillFromPyramid(finest);
    heights = std::move(finest.values);
    if (missing.size() <= kMostSolved) relax(missing, heights, width, height, spacing, progress);
    return static_cast<long long>(missing.size());
}

}  // namespace stereonav
