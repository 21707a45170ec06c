#include "tests/combinations/judging.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>
#include <vector>

namespace stereonav::test {
namespace {

int channelOf(PackedColor c, int channel) {
    return static_cast<int>(c >> (10 * channel) & 1023u);
}

std::string colorText(PackedColor c) {
    return fmt::format("({}, {}, {})", channelOf(c, 0), channelOf(c, 1), channelOf(c, 2));
}

struct Counted {
    long long wrong = 0;
    std::string first;

    void add(int x, int y, const std::string& what) {
        if (wrong++ == 0) first = fmt::format("{},{}: {}", x, y, what);
    }
    std::string text(const EyeImage& image, double allowed, const std::string& what) const {
        const double pixels = static_cast<double>(image.width()) * image.height();
        if (static_cast<double>(wrong) <= allowed * pixels) return "";
        return fmt::format("{} of {:.0f} pixels {}, the first at {}", wrong, pixels, what, first);
    }
};

void eachPixel(const EyeImage& image, const std::function<void(int x, int y)>& look) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) look(x, y);
}

bool sameSize(const EyeImage& a, const EyeImage& b) {
    return a.width() == b.width() && a.height() == b.height();
}

// Least and most of each channel within `reach` pixels.
struct Limits {
    std::array<int, 3> low{1023, 1023, 1023}, high{0, 0, 0};
};
Limits limitsAround(const EyeImage& image, int x, int y, int reach) {
    Limits limits;
    for (int v = std::max(0, y - reach); v <= std::min(image.height() - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(image.width() - 1, x + reach); ++u)
            for (int channel = 0; channel < 3; ++channel) {
                const int value = channelOf(image.color.at(u, v), channel);
                limits.low[channel] = std::min(limits.low[channel], value);
                limits.high[channel] = std::max(limits.high[channel], value);
            }
    return limits;
}

// Steps by which the pixel's channels leave what the two oracles have about it; 0 or less: they do not.
int stepsOutside(const EyeImage& image, const Oracles& oracles, int x, int y, int reach) {
    Limits limits = limitsAround(oracles.first, x, y, reach);
    const Limits second = limitsAround(oracles.second, x, y, reach);
    for (int channel = 0; channel < 3; ++channel) {
        limits.low[channel] = std::min(limits.low[channel], second.low[channel]);
        limits.high[channel] = std::max(limits.high[channel], second.high[channel]);
    }
    const PackedColor c = image.color.at(x, y);
    int steps = 0;
    for (int channel = 0; channel < 3; ++channel)
        steps = std::max({steps, limits.low[channel] - channelOf(c, channel),
                          channelOf(c, channel) - limits.high[channel]});
    return steps;
}

// The fewest steps that no more than that share differ by more than.
int stepsThatHold(std::vector<int> differences, double beyond) {
    const auto allowed = static_cast<std::size_t>(beyond * static_cast<double>(differences.size()));
    if (allowed >= differences.size()) return 0;
    std::nth_element(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(allowed),
                     differences.end(), std::greater<>());
    return differences[allowed];
}

}  // namespace

int channelDifference(PackedColor a, PackedColor b) {
    int worst = 0;
    for (int channel = 0; channel < 3; ++channel)
        worst = std::max(worst, std::abs(channelOf(a, channel) - channelOf(b, channel)));
    return worst;
}

std::string wrongNumbers(const EyeImage& image) {
    Counted wrong;
    eachPixel(image, [&](int x, int y) {
        if (!(image.viewDepth.at(x, y) >= 0))
            wrong.add(x, y, fmt::format("depth {}", image.viewDepth.at(x, y)));
        if (!image.depthSpread.empty() &&
            !(image.depthSpread.at(x, y) >= 0 && std::isfinite(image.depthSpread.at(x, y))))
            wrong.add(x, y, fmt::format("spread of depths {}", image.depthSpread.at(x, y)));
        if (image.color.at(x, y) >> 30) wrong.add(x, y, fmt::format("colour {:#x}", image.color.at(x, y)));
    });
    return wrong.text(image, 0, "hold no number");
}

std::string differentBits(const EyeImage& a, const EyeImage& b) {
    if (!sameSize(a, b)) return "sizes differ";
    Counted wrong;
    eachPixel(a, [&](int x, int y) {
        if (a.color.at(x, y) != b.color.at(x, y) || a.viewDepth.at(x, y) != b.viewDepth.at(x, y))
            wrong.add(x, y,
                      fmt::format("{} at {} and {} at {}", colorText(a.color.at(x, y)), a.viewDepth.at(x, y),
                                  colorText(b.color.at(x, y)), b.viewDepth.at(x, y)));
    });
    return wrong.text(a, 0, "differ");
}

std::string tooFar(const EyeImage& image, const EyeImage& oracle, const Nearness& bound) {
    if (!sameSize(image, oracle)) return "sizes differ";
    Counted wrong;
    double sum = 0;
    eachPixel(image, [&](int x, int y) {
        const PackedColor a = image.color.at(x, y), b = oracle.color.at(x, y);
        for (int channel = 0; channel < 3; ++channel)
            sum += std::abs(channelOf(a, channel) - channelOf(b, channel));
        if (channelDifference(a, b) > bound.steps)
            wrong.add(x, y, fmt::format("{} instead of {}", colorText(a), colorText(b)));
    });
    const std::string far =
        wrong.text(image, bound.beyond, fmt::format("differ by more than {} steps", bound.steps));
    const double mean = sum / (3.0 * image.width() * image.height());
    if (!far.empty() || mean <= bound.mean) return far;
    return fmt::format("pictures differ by {:.2f} steps on average, {} are allowed", mean, bound.mean);
}

std::string outOfRange(const EyeImage& image, const Oracles& oracles, const Range& range) {
    if (!sameSize(image, oracles.first) || !sameSize(image, oracles.second)) return "sizes differ";
    Counted wrong;
    eachPixel(image, [&](int x, int y) {
        if (stepsOutside(image, oracles, x, y, range.reach) > range.steps)
            wrong.add(x, y,
                      fmt::format("{} where there is {}", colorText(image.color.at(x, y)),
                                  colorText(oracles.first.color.at(x, y))));
    });
    return wrong.text(image, range.beyond, "are like nothing about them");
}

Nearness nearnessThatHolds(const EyeImage& image, const EyeImage& oracle, double beyond) {
    std::vector<int> differences;
    double sum = 0;
    eachPixel(image, [&](int x, int y) {
        const PackedColor a = image.color.at(x, y), b = oracle.color.at(x, y);
        for (int channel = 0; channel < 3; ++channel)
            sum += std::abs(channelOf(a, channel) - channelOf(b, channel));
        differences.push_back(channelDifference(a, b));
    });
    const double mean = sum / (3.0 * image.width() * image.height());
    return {stepsThatHold(std::move(differences), beyond), beyond, mean};
}

Range rangeThatHolds(const EyeImage& image, const Oracles& oracles, const Range& range) {
    std::vector<int> differences;
    eachPixel(image,
              [&](int x, int y) { differences.push_back(stepsOutside(image, oracles, x, y, range.reach)); });
    return {range.reach, stepsThatHold(std::move(differences), range.beyond), range.beyond};
}

std::string strangeFlatness(const EyeImage& image, const EyeImage& oracle, int reach, double share) {
    if (!sameSize(image, oracle)) return "sizes differ";
    constexpr int kNear = 24;  // steps: dark, but not black
    Counted wrong;
    eachPixel(image, [&](int x, int y) {
        const PackedColor c = image.color.at(x, y);
        const Limits limits = limitsAround(oracle, x, y, reach);
        const int darkest = *std::max_element(limits.low.begin(), limits.low.end());
        const int brightest = *std::min_element(limits.high.begin(), limits.high.end());
        if (c == 0 && darkest > kNear)
            wrong.add(x, y, "black where there is " + colorText(oracle.color.at(x, y)));
        if (c == 0x3FFFFFFFu && brightest < 1023 - kNear)
            wrong.add(x, y, "white where there is " + colorText(oracle.color.at(x, y)));
        if (image.viewDepth.at(x, y) < kMissDepth) return;
        for (int v = std::max(0, y - reach); v <= std::min(image.height() - 1, y + reach); ++v)
            for (int u = std::max(0, x - reach); u <= std::min(image.width() - 1, x + reach); ++u)
                if (oracle.viewDepth.at(u, v) == kMissDepth) return;
        wrong.add(x, y, "nothing where something is met");
    });
    return wrong.text(image, share, "are black, white or background");
}

}  // namespace stereonav::test
