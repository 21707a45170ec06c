// Mip levels of a height field and the thin volume around it.
#include "engine/medium/model/height_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereonav {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Sums of what is known of a level's blocks, and how many samples that are.
struct Sums {
    Plane<double> sum;
    Plane<float> count;
};

Sums sumsOf(const Plane<float>& heights) {
    Sums s{Plane<double>(heights.width(), heights.height()), Plane<float>(heights.width(), heights.height())};
    for (int y = 0; y < heights.height(); ++y)
        for (int x = 0; x < heights.width(); ++x) {
            const bool known = std::isfinite(heights.at(x, y));
            s.sum.at(x, y) = known ? heights.at(x, y) : 0.0;
            s.count.at(x, y) = known ? 1.0f : 0.0f;
        }
    return s;
}

Sums halved(const Sums& fine) {
    const int width = fine.sum.width() / 2, height = fine.sum.height() / 2;
    Sums s{Plane<double>(width, height), Plane<float>(width, height)};
    const auto four = [](const auto& plane, int x, int y) {
        return plane.at(2 * x, 2 * y) + plane.at(2 * x + 1, 2 * y) + plane.at(2 * x, 2 * y + 1) +
               plane.at(2 * x + 1, 2 * y + 1);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            s.sum.at(x, y) = four(fine.sum, x, y);
            s.count.at(x, y) = four(fine.count, x, y);
        }
    return s;
}

Plane<float> meansOf(const Sums& s) {
    Plane<float> means(s.sum.width(), s.sum.height());
    for (int y = 0; y < means.height(); ++y)
        for (int x = 0; x < means.width(); ++x)
            means.at(x, y) =
                static_cast<float>(s.count.at(x, y) > 0 ? s.sum.at(x, y) / s.count.at(x, y) : kNaN);
    return means;
}

// Returns a bilinear height; u and v in samples, beyond the outermost ones these count. Unknown where a
// sample that counts is.
double bilinear(const Plane<float>& heights, double u, double v) {
    u = std::clamp(u, 0.0, heights.width() - 1.0);
    v = std::clamp(v, 0.0, heights.height() - 1.0);
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const double s = u - x, t = v - y;
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const double weight = (corner & 1 ? s : 1 - s) * (corner & 2 ? t : 1 - t);
        if (weight > 0) sum += weight * heights.at(x + (corner & 1), y + (corner >> 1));
    }
    return sum;
}

}  // namespace

void makeMipLevels(HeightLayer& layer) {
    layer.levels.resize(std::min<std::size_t>(layer.levels.size(), 1));
    layer.lowest = layer.highest = 0;
    if (layer.levels.empty() || layer.levels[0].empty()) return;
    const Plane<float>& finest = layer.levels[0];
    float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
    for (int y = 0; y < finest.height(); ++y)
        for (int x = 0; x < finest.width(); ++x)
            if (std::isfinite(finest.at(x, y))) {
                lowest = std::min(lowest, finest.at(x, y));
                highest = std::max(highest, finest.at(x, y));
            }
    if (lowest > highest) return;
    layer.lowest = lowest - layer.below;
    layer.highest = highest + layer.above;
    for (Sums sums = sumsOf(finest); std::min(sums.sum.width(), sums.sum.height()) >= 2;) {
        sums = halved(sums);
        layer.levels.push_back(meansOf(sums));
    }
}

double HeightLayer::heightAt(double x, double y, double footprint) const {
    if (levels.empty() || levels[0].empty()) return kNaN;
    const double u = (x - originX) / spacing, v = (y - originY) / spacing;
    if (!(u >= 0 && u <= levels[0].width() - 1 && v >= 0 && v <= levels[0].height() - 1)) return kNaN;
    const double coarsest = static_cast<double>(levels.size()) - 1;
    const double level = footprint > spacing ? std::min(std::log2(footprint / spacing), coarsest) : 0.0;
    // Block n of a level has its middle at (n + 0.5) 2^level - 0.5 samples.
    const auto heightIn = [&](int l) {
        const double size = std::ldexp(1.0, l);
        return bilinear(levels[l], (u + 0.5) / size - 0.5, (v + 0.5) / size - 0.5);
    };
    const int fine = static_cast<int>(level);
    const double share = level - fine;
    return share > 0 ? heightIn(fine) * (1 - share) + heightIn(fine + 1) * share : heightIn(fine);
}

double HeightLayer::colorTexel() const {
    const glm::dvec2 texel = color->gridPerTexel() * colorSpacing;
    return std::sqrt(texel.x * texel.y);
}

glm::vec3 HeightLayer::colorAt(double x, double y, double footprint) const {
    if (!color) return glm::vec3(1.0f);
    const double texels = footprint / colorTexel();
    return color->at((glm::dvec2(x, y) - glm::dvec2(originX, originY)) / colorSpacing,
                     texels > 1 ? std::log2(texels) : 0.0);
}

OpticalProperties HeightLayer::at(const glm::dvec3& world, double footprint) const {
    if (!(world.z >= lowest && world.z <= highest)) return {};
    const double height = heightAt(world.x, world.y, footprint);
    const double inside = std::min(world.z - height + below, height + above - world.z);  // NaN where unknown
    if (!(inside >= 0)) return {};
    const float weight = static_cast<float>(taper > 0 ? std::min(inside / taper, 1.0) : 1.0);
    OpticalProperties properties = table.at(height, 0);
    properties.extinction *= weight;
    properties.indirectExtinction *= weight;
    properties.color *= colorAt(world.x, world.y, footprint);
    return properties;
}

}  // namespace stereonav
