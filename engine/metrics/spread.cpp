#include "engine/metrics/spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stereonav {

double Spread::relative() const {
    return median != 0 ? std::abs(0.5 * (high - low) / median) : 0.0;
}

Spread spreadOf(std::vector<double> samples) {
    std::erase_if(samples, [](double s) { return !std::isfinite(s); });
    if (samples.empty()) return {};
    std::sort(samples.begin(), samples.end());
    const std::size_t middle = samples.size() / 2;
    const double median = samples.size() % 2
                              ? samples[middle]
                              : samples[middle - 1] + 0.5 * (samples[middle] - samples[middle - 1]);
    return {median, samples.front(), samples.back(), static_cast<int>(samples.size())};
}

Spread exactly(double value) {
    return {value, value, value, 1};
}

Spread scaled(const Spread& spread, double factor) {
    return {spread.median * factor, spread.low * factor, spread.high * factor, spread.count};
}

std::string numberText(double value) {
    if (!std::isfinite(value)) return std::isnan(value) ? "none" : value > 0 ? "infinite" : "-infinite";
    const double size = std::abs(value);
    if (size != 0 && (size < 1e-4 || size >= 1e7)) return fmt::format("{:.2e}", value);
    if (size >= 100) return fmt::format("{:.0f}", value);
    return fmt::format("{:.3g}", value);
}

std::string spreadText(const Spread& spread) {
    if (spread.count == 0) return "not measured";
    const std::string middle = numberText(spread.median), low = numberText(spread.low),
                      high = numberText(spread.high);
    return low == high ? middle : fmt::format("{} ({} to {})", middle, low, high);
}

}  // namespace stereonav
