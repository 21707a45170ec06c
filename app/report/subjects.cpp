#include "app/report/subjects.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <random>

namespace stereonav {
namespace {

double rootMeanSquare(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v * v;
    return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

GreyVolume blockWithHoles() {
    constexpr double kNoise = 3, kPerVoxel = 50;  // noise of values; their change per voxel at the surface
    VolumeFrame frame;
    frame.size = {72, 96, 56};
    frame.spacing = glm::dvec3(1e-3);
    GreyVolume volume(frame);
    const glm::dvec3 middle = 0.5 * glm::dvec3(frame.size - 1);
    std::mt19937 random(1);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                const glm::dvec3 p = glm::dvec3(i, j, k) - middle;
                const glm::dvec3 beyond = glm::abs(p) - glm::dvec3(29, 41, 21);
                double inside = -std::max({beyond.x, beyond.y, beyond.z});
                for (int hole = -1; hole <= 1; ++hole)
                    inside = std::min(inside, std::hypot(p.x, p.y - 26 * hole) - 10);
                // The sum of twelve uniform numbers is nearly normal, and equal with every library.
                double noise = -6;
                for (int n = 0; n < 12; ++n) noise += static_cast<double>(random()) / 4294967296.0;
                const double value =
                    kBlockSurface + kPerVoxel * std::clamp(inside, -2.0, 2.0) + kNoise * noise;
                volume.at(i, j, k) = static_cast<std::int16_t>(std::lround(std::clamp(value, 0.0, 200.0)));
            }
    return volume;
}

std::vector<glm::ivec3> surfaceVoxels(const GreyVolume& volume, double isovalue, std::size_t most) {
    std::vector<glm::ivec3> all;
    const glm::ivec3 size = volume.frame.size;
    for (int k = 0; k + 1 < size.z; ++k)
        for (int j = 0; j + 1 < size.y; ++j)
            for (int i = 0; i + 1 < size.x; ++i) {
                double least = 1e300, largest = -1e300;
                for (int n = 0; n < 8; ++n) {
                    const double v = volume.at(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2));
                    least = std::min(least, v), largest = std::max(largest, v);
                }
                if (least < isovalue && largest >= isovalue) all.emplace_back(i, j, k);
            }
    if (all.size() <= most) return all;
    std::vector<glm::ivec3> some;
    for (std::size_t n = 0; n < most; ++n) some.push_back(all[n * all.size() / most]);
    return some;
}

double relativeRms(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> off(b.size());
    for (std::size_t n = 0; n < b.size(); ++n) off[n] = a[n] - b[n];
    const double whole = rootMeanSquare(b);
    return whole > 0 ? rootMeanSquare(off) / whole : 0.0;
}

double relativeWorst(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0;
    for (std::size_t n = 0; n < b.size(); ++n) worst = std::max(worst, std::abs(a[n] - b[n]));
    const double whole = rootMeanSquare(b);
    return whole > 0 ? worst / whole : 0.0;
}

}  // namespace stereonav
