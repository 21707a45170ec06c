// Evenly spaced entries of a transfer function, and linear lookup between them: the definition of a medium's
// properties for plain code, kernels and shaders alike.
#include "engine/medium/model/medium_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr int kTableColumns = MediumTable::kValues + 1;

// Lower entry and the share of the one above. NaN counts as 0.
struct Place {
    int low = 0;
    double share = 0;
};
Place placeOf(double x, int intervals) {
    const double inside = x > 0 ? std::min(x, static_cast<double>(intervals)) : 0.0;
    const int low = std::min(static_cast<int>(inside), std::max(intervals - 1, 0));
    return {low, inside - low};
}

// Mixes in double precision, so that no result lies beyond a and b once it is a float again.
float mix(float a, float b, double s) {
    return static_cast<float>(a * (1 - s) + b * s);
}
glm::vec3 mix(const glm::vec3& a, const glm::vec3& b, double s) {
    return {mix(a.x, b.x, s), mix(a.y, b.y, s), mix(a.z, b.z, s)};
}
OpticalProperties mix(const OpticalProperties& a, const OpticalProperties& b, double s) {
    if (s == 0) return a;
    OpticalProperties p;
    p.extinction = mix(a.extinction, b.extinction, s);
    p.color = mix(a.color, b.color, s);
    p.indirectExtinction = mix(a.indirectExtinction, b.indirectExtinction, s);
    p.surface = mix(a.surface, b.surface, s);
    p.glow = mix(a.glow, b.glow, s);
    return p;
}

// Empty entries take what has no meaning there from the nearest that are not.
void spreadColors(MediumTable& table) {
    std::vector<std::size_t> reached;
    std::vector<char> known(table.entries.size(), 0);
    for (std::size_t n = 0; n < known.size(); ++n) {
        if (!(table.entries[n].extinction > 0)) continue;
        known[n] = 1;
        reached.push_back(n);
    }
    const auto give = [&](const OpticalProperties& from, std::size_t to) {
        if (known[to]) return;
        known[to] = 1;
        table.entries[to].color = from.color;
        table.entries[to].surface = from.surface;
        table.entries[to].glow = from.glow;
        reached.push_back(to);
    };
    for (std::size_t next = 0; next < reached.size(); ++next) {
        const std::size_t n = reached[next], column = n % kTableColumns;
        const OpticalProperties from = table.entries[n];
        if (column > 0) give(from, n - 1);
        if (column + 1 < kTableColumns) give(from, n + 1);
        if (n >= kTableColumns) give(from, n - kTableColumns);
        if (n + kTableColumns < known.size()) give(from, n + kTableColumns);
    }
}

// Places the columns over [lowest, highest]; returns the value of the last one.
double layOut(MediumTable& table, double lowest, double highest) {
    const double first = std::floor(lowest), last = std::ceil(highest);
    table.firstValue = lowest;
    if (!(highest > lowest)) return lowest;
    const double perWhole = std::floor(MediumTable::kValues / (last - first));
    // Unless most entries would lie where no data are: values of small parts of one.
    const bool whole = perWhole * (highest - lowest) >= MediumTable::kValues / 2.0;
    if (whole) table.firstValue = first;
    table.perValue = whole ? perWhole : MediumTable::kValues / (highest - lowest);
    return whole ? first + MediumTable::kValues / perWhole : highest;
}

void fillEntries(MediumTable& table, const MediumTransfer& transfer, double lastValue) {
    const double step = table.perValue > 0 ? 1 / table.perValue : 0;
    for (int row = 0; row < table.rows; ++row) {
        const double gradient = table.rows > 1 ? row / table.perGradient : 0;
        for (int i = 0; i < kTableColumns; ++i) {
            const double value = i == MediumTable::kValues ? lastValue : table.firstValue + i * step;
            OpticalProperties& entry = table.entries[static_cast<std::size_t>(row) * kTableColumns + i];
            entry = transfer.at(value, gradient);
            table.largest[i] = std::max(table.largest[i], entry.extinction);
        }
    }
}

}  // namespace

OpticalProperties MediumTable::at(double value, double gradient) const {
    if (entries.empty()) return {};
    const Place column = placeOf((value - firstValue) * perValue, kValues);
    const auto alongRow = [&](int row) {
        const OpticalProperties* entry = &entries[static_cast<std::size_t>(row) * kTableColumns + column.low];
        return mix(entry[0], entry[1], column.share);
    };
    if (rows == 1) return alongRow(0);
    const Place row = placeOf(gradient * perGradient, rows - 1);
    return mix(alongRow(row.low), alongRow(row.low + 1), row.share);
}

float MediumTable::largestExtinction(double lowest, double highest) const {
    if (largest.empty() || !(lowest <= highest)) return 0;
    const Place from = placeOf((lowest - firstValue) * perValue, kValues);
    const Place to = placeOf((highest - firstValue) * perValue, kValues);
    return *std::max_element(largest.begin() + from.low, largest.begin() + to.low + (to.share > 0 ? 2 : 1));
}

MediumTransfer::Range MediumTable::visibleRange() const {
    const auto visible = [](float extinction) { return extinction > 0; };
    const auto first = std::find_if(largest.begin(), largest.end(), visible);
    if (first == largest.end()) return {kInfinity, -kInfinity};
    const auto last = std::find_if(largest.rbegin(), largest.rend(), visible);
    if (!(perValue > 0)) return {-kInfinity, kInfinity};
    const auto valueOf = [&](long index) { return firstValue + static_cast<double>(index) / perValue; };
    return {first == largest.begin() ? -kInfinity : valueOf(first - largest.begin() - 1),
            last == largest.rbegin() ? kInfinity : valueOf(last.base() - largest.begin())};
}

MediumTable makeMediumTable(const MediumTransfer& transfer, double lowest, double highest) {
    MediumTable table;
    const MediumTransfer::Range visible = transfer.visibleRange(), changing = transfer.changingRange();
    lowest = std::max(lowest, visible.lowest);
    highest = std::min(highest, visible.highest);
    table.largest.assign(kTableColumns, 0.0f);
    const bool empty = !(lowest <= highest);
    if (!empty && transfer.largestGradient() > 0) {
        table.rows = MediumTable::kGradients + 1;
        table.perGradient = MediumTable::kGradients / transfer.largestGradient();
    }
    table.entries.resize(static_cast<std::size_t>(table.rows) * kTableColumns);
    if (empty) return table;
    const double last = layOut(table, std::clamp(lowest, changing.lowest, changing.highest),
                               std::clamp(highest, changing.lowest, changing.highest));
    fillEntries(table, transfer, last);
    spreadColors(table);
    return table;
}

}  // namespace stereonav
