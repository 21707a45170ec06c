#include "engine/metrics/chart_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/math/nice_step.h"

namespace stereonav {
namespace {

constexpr double kAutomaticRatio = 6;   // ratio of values from which on a scale is logarithmic
constexpr double kMargin = 0.07;        // share of the scale, beyond the values
constexpr double kLeastDecades = 0.25;  // decades of a logarithmic scale
constexpr std::size_t kMostTicks = 7;

std::string tickText(double value) {
    const double size = std::abs(value);
    if (size >= 1e4 && size < 1e6) return fmt::format("{:.4g}k", value / 1000);
    return size != 0 && (size < 1e-3 || size >= 1e5) ? fmt::format("{:.0e}", value)
                                                     : fmt::format("{:.6g}", value);
}

}  // namespace

ChartScale::ChartScale(const std::vector<double>& values, Kind kind) {
    double least = INFINITY, most = -INFINITY, leastAbove = INFINITY;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        least = std::min(least, value);
        most = std::max(most, value);
        if (value > 0) leastAbove = std::min(leastAbove, value);
    }
    mLogarithmic = kind == Kind::Logarithmic ||
                   (kind == Kind::Automatic && least > 0 && most >= kAutomaticRatio * least);
    if (kind == Kind::Around && std::isfinite(least)) {
        const double room = std::max(kMargin * (most - least), 0.5);
        mLow = least - room;
        mHigh = most + room;
    } else if (!mLogarithmic) {
        if (std::isfinite(least)) choose(least, most);
    } else if (std::isfinite(leastAbove)) {
        choose(std::log10(leastAbove), std::log10(most));
    } else {
        choose(0, 1);  // nothing above zero: 1 to 10
    }
}

void ChartScale::choose(double least, double most) {
    if (mLogarithmic) {
        const double missing = std::max(0.0, kLeastDecades - (most - least));
        mLow = least - missing / 2;
        mHigh = most + missing / 2;
    } else {
        mLow = std::min(least, 0.0);
        mHigh = std::max(most, 0.0);
        if (!(mHigh > mLow)) mHigh = mLow + 1;
    }
    const double margin = kMargin * (mHigh - mLow);
    if (mLogarithmic || mLow < 0) mLow -= margin;
    mHigh += margin;
}

double ChartScale::place(double value) const {
    const double at = mLogarithmic ? (value > 0 ? std::log10(value) : -INFINITY) : value;
    const double share = (at - mLow) / (mHigh - mLow);
    return share > 0 ? std::min(share, 1.0) : 0.0;
}

std::vector<ChartScale::Tick> ChartScale::ticks() const {
    std::vector<Tick> ticks;
    if (!mLogarithmic) {
        const double step = niceStep(mHigh - mLow);
        for (double k = std::ceil(mLow / step); k * step <= mHigh; ++k)
            ticks.push_back({k * step, tickText(k * step)});
        return ticks;
    }
    // finer and finer until there are two ticks at least
    for (const std::vector<double>& digits : {std::vector<double>{1},
                                              {1, 3},
                                              {1, 2, 5},
                                              {1, 1.5, 2, 3, 5, 7},
                                              {1, 1.2, 1.4, 1.7, 2, 2.4, 3, 3.5, 4.2, 5, 6, 7, 8.5}}) {
        ticks.clear();
        for (double power = std::floor(mLow); power <= mHigh; ++power)
            for (const double digit : digits) {
                const double at = power + std::log10(digit);
                if (at >= mLow && at <= mHigh)
                    ticks.push_back({digit * std::pow(10.0, power), tickText(digit * std::pow(10.0, power))});
            }
        if (ticks.size() >= 3) break;
    }
    const std::size_t every = (ticks.size() + kMostTicks - 1) / kMostTicks;
    std::vector<Tick> some;
    for (std::size_t n = 0; n < ticks.size(); n += std::max<std::size_t>(every, 1)) some.push_back(ticks[n]);
    return some;
}

}  // namespace stereonav
