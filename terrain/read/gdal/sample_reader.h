// Interpolates elevation samples: cubic, limited to the range of the samples around.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

#include "terrain/read/gdal/dem_samples.h"

namespace stereonav {

// Catmull-Rom weights of the four samples around fraction u of the middle two.
inline std::array<double, 4> cubicWeights(double u) {
    return {((-0.5 * u + 1) * u - 0.5) * u, (1.5 * u - 2.5) * u * u + 1, ((-1.5 * u + 2) * u + 0.5) * u,
            (0.5 * u - 0.5) * u * u};
}

// Reads between samples: cubic where all sixteen around are known, else bilinear over the known ones of the
// four nearest.
class SampleReader {
public:
    // samples: of a window of the raster, whose sizes are width and height.
    SampleReader(const float* samples, const SampleWindow& window, int width, int height)
        : mSamples(samples), mWindow(window), mWidth(width), mHeight(height) {}

    // Returns a sample within the window.
    float at(int i, int j) const {
        return mSamples[static_cast<std::size_t>(j - mWindow.y) * mWindow.width + (i - mWindow.x)];
    }

    // Returns whether there is ground: up to half a sample beyond the outermost samples.
    bool inside(const glm::dvec2& pixel) const {
        constexpr double kSlack = 0.51;
        const double x = pixel.x - 0.5, y = pixel.y - 0.5;
        return x >= -kSlack && y >= -kSlack && x <= mWidth - 1 + kSlack && y <= mHeight - 1 + kSlack;
    }

    // Returns the window of samples that between() may read for places with x and y from low to high.
    SampleWindow around(const glm::dvec2& low, const glm::dvec2& high) const {
        const auto first = [](double x, int count) {
            return std::max(static_cast<int>(std::clamp(x - 0.5, 0.0, count - 2.0)) - 1, 0);
        };
        const auto last = [](double x, int count) {
            return std::min(static_cast<int>(std::clamp(x - 0.5, 0.0, count - 2.0)) + 2, count - 1);
        };
        const int x = first(low.x, mWidth), y = first(low.y, mHeight);
        return {x, y, last(high.x, mWidth) - x + 1, last(high.y, mHeight) - y + 1};
    }

    // Returns the interpolated value at a place for which inside() is true.
    float between(const glm::dvec2& pixel) const {
        const double x = std::clamp(pixel.x - 0.5, 0.0, mWidth - 1.0);
        const double y = std::clamp(pixel.y - 0.5, 0.0, mHeight - 1.0);
        const float nearest = at(static_cast<int>(x + 0.5), static_cast<int>(y + 0.5));
        if (std::isnan(nearest)) return nearest;
        const int i = std::min(static_cast<int>(x), mWidth - 2),
                  j = std::min(static_cast<int>(y), mHeight - 2);
        const double cubic = cubicAt(i, j, x - i, y - j);
        return static_cast<float>(std::isnan(cubic) ? bilinearAt(i, j, x - i, y - j) : cubic);
    }

private:
    // Returns the cubic interpolation; NaN where one of the sixteen is missing. It overshoots beside cliffs
    // and between two samples of a summit, to heights that the file does not have.
    double cubicAt(int i, int j, double u, double v) const {
        if (i < 1 || j < 1 || i + 2 >= mWidth || j + 2 >= mHeight)
            return std::numeric_limits<double>::quiet_NaN();
        const auto wx = cubicWeights(u), wy = cubicWeights(v);
        double sum = 0;
        for (int b = 0; b < 4; ++b)
            for (int a = 0; a < 4; ++a) sum += wx[a] * wy[b] * at(i - 1 + a, j - 1 + b);
        if (std::isnan(sum)) return sum;
        const auto [low, high] = std::minmax({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        return std::clamp(sum, double(low), double(high));
    }

    double bilinearAt(int i, int j, double u, double v) const {
        double sum = 0, weights = 0;
        for (int b = 0; b < 2; ++b)
            for (int a = 0; a < 2; ++a) {
                const float h = at(i + a, j + b);
                if (std::isnan(h)) continue;
                const double w = (a ? u : 1 - u) * (b ? v : 1 - v);
                sum += w * h;
                weights += w;
            }
        return sum / weights;  // the nearest of the four is known, so weights >= 1/4
    }

    const float* mSamples;
    SampleWindow mWindow;
    int mWidth, mHeight;
};

}  // namespace stereonav
