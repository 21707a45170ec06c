#include "engine/volume/transfer_integrals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace stereonav {
namespace {

// Means of the extinction, a metre, and of it times red, green and blue.
using FourMeans = std::array<double, 4>;

// Returns the means over values from `begin` on, `width` of them, by samples in the middle of equal parts.
FourMeans meansOver(const TransferFunction& function, double begin, double width) {
    constexpr int kParts = 8;
    FourMeans means{};
    for (int n = 0; n < kParts; ++n) {
        const double value = begin + (n + 0.5) / kParts * width;
        const double extinction = function.extinction(value) / kParts;
        const glm::dvec3 color(function.at(value).color);
        means[0] += extinction;
        for (int c = 0; c < 3; ++c) means[static_cast<std::size_t>(c) + 1] += extinction * color[c];
    }
    return means;
}

}  // namespace

TransferIntegrals::TransferIntegrals(const TransferFunction& function, const GreyVolume& field,
                                     double isovalue) {
    constexpr int kEntries = IntegralData::kEntries;
    const auto& points = function.points();
    const double first = points.front().value, last = std::max(points.back().value, first + 1e-3);
    const double width = (last - first) / kEntries;
    std::vector<FourMeans> means;
    means.reserve(kEntries + 2);
    double most = 0;
    for (int k = -1; k <= kEntries; ++k) {
        // Beyond its ends the function is constant.
        means.push_back(meansOver(function, first + k * width, width));
        most += means.back()[0];
    }
    const double quantum = std::max(most, 1e-30) / (1 << 30);
    FourMeans sum{};
    for (const FourMeans& mean : means)
        for (std::size_t c = 0; c < mean.size(); ++c) {
            mTable.push_back(static_cast<std::uint32_t>(std::lround(sum[c] / quantum)));
            mTable.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(mean[c])));
            sum[c] += mean[c];
        }
    const auto place = [&](double value) { return static_cast<float>((value - first) / width + 1); };
    const TransferFunction::Range seen = function.visibleRange();
    mData.table = mTable.data();
    mData.scale = static_cast<float>(field.scale / width);
    mData.offset = place(isovalue * field.scale + field.offset);
    mData.quantum = static_cast<float>(quantum);
    mData.lowest = place(seen.lowest);
    mData.highest = place(seen.highest);
}

}  // namespace stereonav
