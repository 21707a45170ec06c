// One pass over the voxels for their range, one over the cells for those between two values.
#include "engine/medium/model/medium_extent.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Stored numbers before `from` and those after `to` lie on either side of what is looked for; which side is
// which depends on the sign of the scale and does not matter.
struct Sides {
    int from, to;
    std::uint8_t of(std::int16_t stored) const {
        return static_cast<std::uint8_t>((stored < from ? 1 : 0) | (stored > to ? 2 : 0));
    }
};

Sides sidesOf(const GreyVolume& field, double lowest, double highest) {
    constexpr int kFirst = std::numeric_limits<std::int16_t>::min(),
                  kLast = std::numeric_limits<std::int16_t>::max();
    const auto side = [&](int stored) {
        const double value = stored * field.scale + field.offset;
        return value <= lowest ? -1 : value >= highest ? 1 : 0;
    };
    Sides sides{kFirst, kLast};
    if (side(kFirst) != 0)
        while (sides.from <= kLast && side(sides.from) == side(kFirst)) ++sides.from;
    if (side(kLast) != 0)
        while (sides.to >= kFirst && side(sides.to) == side(kLast)) --sides.to;
    return sides;
}

// Finds for each place of a row the side on which all four voxels around it lie, between two rows and two
// slices; 0: they lie on different sides.
void classifyRow(const GreyVolume& field, const Sides& sides, int j, int k, std::vector<std::uint8_t>& row) {
    const std::int16_t* at[4];
    for (int n = 0; n < 4; ++n) at[n] = field.values.data() + field.frame.index(0, j + (n & 1), k + (n >> 1));
    for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = sides.of(at[0][i]) & sides.of(at[1][i]) & sides.of(at[2][i]) & sides.of(at[3][i]);
}

CellBox cellsOfSlice(const GreyVolume& field, const Sides& sides, int k) {
    const glm::ivec3 size = field.frame.size;
    CellBox box{size, glm::ivec3(-1)};
    std::vector<std::uint8_t> row(size.x);
    for (int j = 0; j + 1 < size.y; ++j) {
        classifyRow(field, sides, j, k, row);
        for (int i = 0; i + 1 < size.x; ++i) {
            if (row[i] & row[i + 1]) continue;
            box.first = glm::min(box.first, glm::ivec3(i, j, k));
            box.last = glm::max(box.last, glm::ivec3(i + 1, j + 1, k + 1));
        }
    }
    return box;
}

}  // namespace

GreyRange valueRange(const GreyVolume& field) {
    const glm::ivec3 size = field.frame.size;
    const std::size_t slice = static_cast<std::size_t>(size.x) * size.y;
    std::vector<std::pair<std::int16_t, std::int16_t>> ranges(size.z);
    parallelFor(size.z, [&](int k) {
        const std::int16_t* first = field.values.data() + slice * k;
        const auto [low, high] = std::minmax_element(first, first + slice);
        ranges[k] = {*low, *high};
    });
    std::int16_t low = ranges[0].first, high = ranges[0].second;
    for (const auto& range : ranges) {
        low = std::min(low, range.first);
        high = std::max(high, range.second);
    }
    const double a = low * field.scale + field.offset, b = high * field.scale + field.offset;
    return {std::min(a, b), std::max(a, b)};
}

CellBox cellsBetween(const GreyVolume& field, double lowest, double highest) {
    if (!(lowest <= highest)) return {};
    const Sides sides = sidesOf(field, lowest, highest);
    std::vector<CellBox> boxes(std::max(field.frame.size.z - 1, 0));
    parallelFor(static_cast<int>(boxes.size()), [&](int k) { boxes[k] = cellsOfSlice(field, sides, k); });
    CellBox all{field.frame.size, glm::ivec3(-1)};
    for (const CellBox& box : boxes) {
        if (box.empty()) continue;
        all.first = glm::min(all.first, box.first);
        all.last = glm::max(all.last, box.last);
    }
    return all.empty() ? CellBox{} : all;
}

}  // namespace stereonav
