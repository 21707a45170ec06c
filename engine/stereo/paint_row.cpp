// For a right eye the occlusion-compatible order along a row is left to right: of two left pixels that
// meet in the right eye the one further right is the nearer.
#include "engine/stereo/paint_row.h"

#include <algorithm>
#include <cmath>

namespace stereonav {

void paintRow(const PaintRow& row) {
    std::fill_n(row.color, row.width, 0u);
    std::fill_n(row.depth, row.width, 0.0f);
    std::fill_n(row.holes, row.width, std::uint8_t{255});
    std::fill_n(row.source, row.width, -1);
    const float width = static_cast<float>(row.width);
    for (int i = 0; i < row.width; ++i) {
        const float column = (static_cast<float>(i) + 0.5f) + (row.shift - row.scale / row.leftDepth[i]);
        if (!(column > -2.0f && column < width + 2.0f)) continue;
        // Pixels whose centre lies within half a splat of the column.
        const int begin = std::max(0, static_cast<int>(std::ceil(column - kPaintWidth / 2 - 0.5f)));
        const int end =
            std::min(row.width, static_cast<int>(std::floor(column + kPaintWidth / 2 - 0.5f)) + 1);
        for (int p = begin; p < end; ++p) {
            row.color[p] = row.leftColor[i];
            row.depth[p] = row.leftDepth[i];
            row.holes[p] = 0;
            row.source[p] = i;
        }
    }
}

}  // namespace stereonav
