#include "colon/scene/value_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stereonav {
namespace {

constexpr int kLeastNumber = -32768;
constexpr std::size_t kBins = 256;
constexpr double kTail = 0.0005;                     // share of voxels above the bins
constexpr double kSkinOfCt = -300, kBoneOfCt = 300;  // HU
constexpr double kBoneOfBody = 0.002;                // share: less is a contrast agent

// Calls use(value, voxels) for each value that occurs, ascending.
template <typename Use>
void forValues(const ValueCounts& counts, const Use& use) {
    const std::size_t size = counts.counts.size();
    for (std::size_t n = 0; n < size; ++n) {
        const std::size_t index = counts.scale < 0 ? size - 1 - n : n;
        if (counts.counts[index] == 0) continue;
        const double number = static_cast<double>(index) + kLeastNumber;
        use(number * counts.scale + counts.offset, static_cast<double>(counts.counts[index]));
    }
}

double countBetween(const ValueCounts& counts, double low, double high) {
    double sum = 0;
    forValues(counts, [&](double value, double voxels) {
        if (value >= low && value < high) sum += voxels;
    });
    return sum;
}

// Voxels with values of one part of the range.
struct Bin {
    double least = 0, most = 0;  // values
    double voxels = 0, sum = 0;  // sum: of values, in bins from the first one on
};

// Equal parts of the range of all values but the largest few, which are in the last one.
struct Bins {
    std::vector<Bin> all{kBins};
    std::size_t filled = 0;  // those that are not empty

    double voxelsIn(std::size_t from, std::size_t end) const {
        double sum = 0;
        for (std::size_t n = from; n < end; ++n) sum += all[n].voxels;
        return sum;
    }
};
Bins binsOf(const ValueCounts& counts) {
    const double lowest = counts.lowest();
    double voxels = 0, below = 0, top = counts.highest();
    forValues(counts, [&](double, double count) { voxels += count; });
    forValues(counts, [&](double value, double count) {
        if (below < (1 - kTail) * voxels) top = value;
        below += count;
    });
    // Each bin takes as many stored numbers as the others: dips between bins of one number and of two are no
    // valleys.
    const double step = std::abs(counts.scale);
    const double least = (top - lowest) / static_cast<double>(kBins - 1);
    const double width = std::isfinite(least / step) ? std::ceil(least / step * (1 - 1e-12)) * step : least;
    Bins bins;
    forValues(counts, [&](double value, double count) {
        const double at = width > 0 ? std::min((value - lowest) / width, static_cast<double>(kBins - 1)) : 0;
        Bin& bin = bins.all[static_cast<std::size_t>(at)];
        if (bin.voxels == 0) {
            bin.least = value;
            ++bins.filled;
        }
        bin.most = value;
        bin.voxels += count;
        bin.sum += count * at;
    });
    return bins;
}

// Numbers of the first bins of the second and the third class.
struct Classes {
    std::size_t second = 1, third = 2;
};
// Returns the three classes between which the variance is largest.
Classes threeClasses(const Bins& bins) {
    std::vector<double> voxels(1), sums(1);
    for (const Bin& bin : bins.all) {
        voxels.push_back(voxels.back() + bin.voxels);
        sums.push_back(sums.back() + bin.sum);
    }
    const auto part = [&](std::size_t from, std::size_t to) {
        const double sum = sums[to] - sums[from], count = voxels[to] - voxels[from];
        return count > 0 ? sum / count * sum : 0;
    };
    Classes best;
    double most = -1;
    for (std::size_t a = 1; a + 1 < kBins; ++a)
        for (std::size_t b = a + 1; b < kBins; ++b) {
            const double variance = part(0, a) + part(a, b) + part(b, kBins);
            if (variance > most) {
                most = variance;
                best = {a, b};
            }
        }
    return best;
}

// Voxels in some bins around one.
double around(const Bins& bins, std::size_t at) {
    constexpr std::size_t kReach = 2;
    return bins.voxelsIn(at < kReach ? 0 : at - kReach, std::min(at + kReach + 1, kBins));
}

// Whether bins on both sides of one hold clearly more voxels than it: the flank of a single peak has one
// side.
bool isValley(const Bins& bins, std::size_t at) {
    constexpr double kClearly = 1.25;
    double below = 0, above = 0;
    for (std::size_t n = 0; n < kBins; ++n) {
        double& side = n < at ? below : above;
        side = std::max(side, around(bins, n));
    }
    return std::min(below, above) > kClearly * around(bins, at);
}

// Returns the first bin of the emptiest valley around a border between classes, the border where there is
// none: it may move by 40 % down and 60 % up, and not to `end`.
std::size_t valleyAt(const Bins& bins, std::size_t border, std::size_t end) {
    const std::size_t from = std::max<std::size_t>(1, border - border * 4 / 10);
    const std::size_t to = std::min(border + border * 6 / 10, end - 1);
    std::size_t best = border;
    for (std::size_t at = from; at <= to; ++at)
        if (around(bins, at) < around(bins, best) && isValley(bins, at)) best = at;
    return best;
}

// Returns the first bin of what is no background. Where the lower border cuts through the background's peak,
// as noise is spread, it is the upper one.
std::size_t objectFrom(const Bins& bins, const Classes& classes) {
    constexpr double kInPeak = 0.25;
    const std::size_t lower = valleyAt(bins, classes.second, classes.third);
    double peak = 0;
    for (std::size_t n = 0; n < classes.second; ++n) peak = std::max(peak, around(bins, n));
    return around(bins, lower) > kInPeak * peak ? valleyAt(bins, classes.third, kBins) : lower;
}

// Returns the value half way between what is in the bins below and what is in the others.
double between(const Bins& bins, std::size_t second) {
    std::size_t below = second - 1, above = second;
    while (below > 0 && bins.all[below].voxels == 0) --below;
    while (above + 1 < kBins && bins.all[above].voxels == 0) ++above;
    return 0.5 * bins.all[below].most + 0.5 * bins.all[above].least;
}

// Whether values are those of a CT whose numbers begin at air: most of what is no air is as soft as water.
bool looksShifted(const ValueCounts& counts, double lowest, double highest) {
    if (lowest < -100 || lowest > 200 || highest < 1300 || highest > 10000) return false;
    const double soft = countBetween(counts, kWaterOfShifted - 150, kWaterOfShifted + 130);
    const double body = countBetween(counts, 500, highest + 1);
    return soft > 0.35 * body && body > 0;
}

// The thresholds of values that are no Hounsfield units.
void partValues(const ValueCounts& counts, ValueKinds& kinds) {
    const Bins bins = binsOf(counts);
    int values = 0;
    forValues(counts, [&](double, double) { ++values; });
    kinds.mask = values == 2;
    if (values < 2) {
        kinds.object = kinds.dense = kinds.highest;
    } else if (bins.filled <= 2) {
        kinds.object = bins.filled == 2 ? between(bins, 1) : 0.5 * kinds.lowest + 0.5 * kinds.highest;
        kinds.dense = 0.5 * kinds.object + 0.5 * kinds.highest;
    } else {
        const Classes classes = threeClasses(bins);
        kinds.object = between(bins, objectFrom(bins, classes));
        kinds.dense = std::max(between(bins, classes.third), kinds.object);
    }
}

}  // namespace

std::string ValueKinds::text() const {
    return fmt::format("{} from {:.6g} to {:.6g}", hounsfield ? "HU" : "values", lowest, highest);
}

ValueKinds kindsOf(const ValueCounts& counts, bool hounsfield, const VolumeFrame& frame) {
    ValueKinds kinds;
    kinds.spacing = std::cbrt(frame.spacing.x * frame.spacing.y * frame.spacing.z);
    kinds.lowest = counts.lowest();
    kinds.highest = counts.highest();
    kinds.hounsfield = hounsfield && kinds.highest > kSkinOfCt;  // air alone has no skin
    if (kinds.hounsfield) {
        kinds.object = kSkinOfCt;
        kinds.dense = kBoneOfCt;
        return kinds;
    }
    kinds.shifted = looksShifted(counts, kinds.lowest, kinds.highest);
    partValues(counts, kinds);
    return kinds;
}

IsovalueChoice isovalueFor(const ValueCounts& counts, const ValueKinds& kinds) {
    if (!kinds.hounsfield)
        return {kinds.object, kinds.mask ? "half way between the two values of a mask"
                                         : "between background and object, in the histogram's valley"};
    const double all = countBetween(counts, kinds.lowest, kinds.highest + 1);
    const double bone = countBetween(counts, kBoneOfCt, kinds.highest + 1);
    if (bone < kBoneOfBody * all) return {kSkinOfCt, "skin, as there is little bone"};
    constexpr double kStep = 50;  // HU
    for (double value = kBoneOfCt - 2 * kStep; value < kBoneOfCt; value += kStep)
        // Rims of bone are as much again for each step of 100 HU; more is vessels with contrast, or noise.
        if (countBetween(counts, value, kBoneOfCt) <= 2 * bone * (kBoneOfCt - value) / 100)
            return {value, "bone"};
    return {kBoneOfCt, "bone, above what contrast makes as bright"};
}

}  // namespace stereonav
