// The measure is found twice: at a scale that cuts hardly anything, whose distribution gives the scale that
// is kept.
#include "engine/light/occlusion/occlusion_modulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/base/error.h"

namespace stereonav {
namespace {

// Returns the largest standard deviation that a box's values can have: half the difference of the volume's
// extremes; 1 where all values are equal.
double largestSigma(const GreyVolume& volume) {
    int low = 32767, high = -32768;
    for (std::size_t n = 0; n < volume.values.size(); ++n) {
        low = std::min<int>(low, volume.values[n]);
        high = std::max<int>(high, volume.values[n]);
    }
    const double sigma = 0.5 * (high - low) * std::abs(static_cast<double>(volume.scale));
    return sigma > 0 ? sigma : 1.0;
}

// Returns, by stored number + 32768, whether the function shows it.
std::vector<char> shownNumbers(const GreyVolume& volume, const TransferFunction& transfer) {
    std::vector<char> shown(65536);
    for (int n = 0; n < 65536; ++n)
        shown[static_cast<std::size_t>(n)] =
            transfer.extinction((n - 32768) * static_cast<double>(volume.scale) + volume.offset) > 0;
    return shown;
}

// Returns the least measure, 1..255, that is exceeded by at most kWhollyOpaque of the shown voxels' measures
// above 0; 255 where there are none.
int scaleOf(const Volume<std::uint8_t>& measure, const GreyVolume& volume, const TransferFunction& transfer) {
    const std::vector<char> shown = shownNumbers(volume, transfer);
    std::array<std::size_t, 256> counts{};
    for (std::size_t n = 0; n < measure.values.size(); ++n)
        if (shown[static_cast<std::size_t>(volume.values[n] + 32768)]) ++counts[measure.values[n]];
    const std::size_t all = std::accumulate(counts.begin() + 1, counts.end(), std::size_t{0});
    if (all == 0) return 255;
    std::size_t above = 0;
    for (int level = 255; level > 1; --level) {
        above += counts[static_cast<std::size_t>(level)];
        if (static_cast<double>(above) > kWhollyOpaque * static_cast<double>(all)) return level;
    }
    return 1;
}

OpacityModulation byVariance(const GreyVolume& volume, const ModulationSetting& setting,
                             const TransferFunction& transfer, Progress& progress) {
    const auto cutAt = [&](double sigma, Progress& part) {
        return OpacityModulation{varianceModulation(volume, setting.radius, sigma, part), sigma};
    };
    if (setting.sigma) return cutAt(*setting.sigma, progress);
    Progress measuring(progress, 0, 0.5), cutting(progress, 0.5, 1);
    const OpacityModulation measure = cutAt(largestSigma(volume), measuring);
    return cutAt(measure.sigma * std::sqrt(scaleOf(measure.share, volume, transfer) / 255.0), cutting);
}

OpacityModulation byGradient(const GreyVolume& volume, const ModulationSetting& setting,
                             const TransferFunction& transfer, Progress& progress) {
    // Steeper than from closed to open within four voxels is cut alike, where the scale is chosen.
    constexpr double kSteep = 0.25;
    const OpennessVolume openness = estimateOpenness(volume, setting.openness, setting.radius, progress);
    const auto cutAt = [&](double slope) {
        return OpacityModulation{gradientModulation(openness, slope), slope};
    };
    if (setting.sigma) return cutAt(*setting.sigma);
    return cutAt(kSteep * scaleOf(cutAt(kSteep).share, volume, transfer) / 255.0);
}

}  // namespace

OpacityModulation opacityModulation(const GreyVolume& volume, const ModulationSetting& setting,
                                    const TransferFunction& transfer, Progress& progress) {
    if (setting.by == ModulatedBy::Variance) return byVariance(volume, setting, transfer, progress);
    if (setting.sigma && !(*setting.sigma <= kSteepestOpenness))
        throw Error(
            "", "sigma of the opacity modulation",
            fmt::format("expected at most {:g} by the gradient, got {:g}", kSteepestOpenness, *setting.sigma),
            "0.05 is a slope that surfaces have");
    return byGradient(volume, setting, transfer, progress);
}

}  // namespace stereonav
