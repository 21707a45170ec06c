// One pass over the voxels for their range, one over the cells for those between two values.
#include "engine/medium/medium_extent.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Of a voxel: at or below the lower value, at or above the higher one, between.
constexpr std::uint8_t kBelow = 1, kAbove = 2, kBetween = 4;

struct Classifier {
    double lowest, highest, scale, offset;
    std::uint8_t operator()(std::int16_t stored) const {
        const double value = stored * scale + offset;
        return value <= lowest ? kBelow : value >= highest ? kAbove : kBetween;
    }
};

// What the four voxels around each place of a row between two rows and two slices are, together.
void classifyRow(const GreyVolume& field, const Classifier& classify, int j, int k,
                 std::vector<std::uint8_t>& row) {
    for (int i = 0; i < field.frame.size.x; ++i)
        row[i] = classify(field.at(i, j, k)) | classify(field.at(i, j + 1, k)) |
                 classify(field.at(i, j, k + 1)) | classify(field.at(i, j + 1, k + 1));
}

bool comesBetween(std::uint8_t voxels) {
    return voxels != kBelow && voxels != kAbove;
}

CellBox cellsOfSlice(const GreyVolume& field, const Classifier& classify, int k) {
    const glm::ivec3 size = field.frame.size;
    CellBox box{size, glm::ivec3(-1)};
    std::vector<std::uint8_t> row(size.x);
    for (int j = 0; j + 1 < size.y; ++j) {
        classifyRow(field, classify, j, k, row);
        for (int i = 0; i + 1 < size.x; ++i) {
            if (!comesBetween(row[i] | row[i + 1])) continue;
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
    const Classifier classify{lowest, highest, field.scale, field.offset};
    std::vector<CellBox> boxes(std::max(field.frame.size.z - 1, 0));
    parallelFor(static_cast<int>(boxes.size()), [&](int k) { boxes[k] = cellsOfSlice(field, classify, k); });
    CellBox all{field.frame.size, glm::ivec3(-1)};
    for (const CellBox& box : boxes) {
        if (box.empty()) continue;
        all.first = glm::min(all.first, box.first);
        all.last = glm::max(all.last, box.last);
    }
    return all.empty() ? CellBox{} : all;
}

}  // namespace stereonav
