// The inverse warp, one pixel at a time. Order: columns, survivors from the right, links, the link
// that holds each right pixel's centre, colours.
#include "tests/oracle/warp_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/stereo/packed_resample.h"

namespace stereonav {
namespace {

float columnOf(const ResampleRow& row, int i) {
    return (static_cast<float>(i) + 0.5f) + (row.shift - row.scale / row.leftDepth[i]);
}

std::vector<bool> findSurvivors(const ResampleRow& row) {
    std::vector<bool> survives(row.width);
    float leftmost = std::numeric_limits<float>::infinity();
    for (int i = row.width - 1; i >= 0; --i) {
        row.column[i] = columnOf(row, i);
        survives[i] = row.column[i] < leftmost;
        if (survives[i]) leftmost = row.column[i];
    }
    return survives;
}

bool isWide(const ResampleRow& row, int i) {
    const float depth = row.leftDepth[i];
    return row.leftSpread && row.scale * row.leftSpread[i] > (row.mostSpread * depth) * depth;
}

std::vector<bool> findLinks(const ResampleRow& row, const std::vector<bool>& survives) {
    std::vector<bool> links(row.width, false);
    for (int i = 0; i + 1 < row.width; ++i) {
        const float gap = row.column[i + 1] - row.column[i];
        links[i] = survives[i] && survives[i + 1] && gap >= row.minStretch && gap <= row.maxStretch;
        if (row.surface && std::isinf(row.leftDepth[i]) != std::isinf(row.leftDepth[i + 1])) links[i] = false;
        if (isWide(row, i) || isWide(row, i + 1)) links[i] = false;
    }
    return links;
}

void findInverses(const ResampleRow& row, const std::vector<bool>& links) {
    for (int i = 0; i < row.width; ++i) {
        bool holds = links[i];
        if (row.reach > 0) holds = holds && links[i + 1];
        if (row.reach > 1) holds = holds && i > 0 && links[i - 1];
        row.inverse[i] = holds ? 1.0f / (row.column[i + 1] - row.column[i]) : 0.0f;
    }
}

// source[p]: the rightmost survivor at or left of the centre of p, -1 when there is none.
void findSources(const ResampleRow& row, const std::vector<bool>& survives) {
    std::fill_n(row.source, row.width, -1);
    for (int i = 0; i < row.width; ++i) {
        if (!survives[i]) continue;
        const float first = std::ceil(row.column[i] - 0.5f);
        if (first < static_cast<float>(row.width)) row.source[static_cast<int>(std::max(first, 0.0f))] = i;
    }
    for (int p = 1; p < row.width; ++p) row.source[p] = std::max(row.source[p], row.source[p - 1]);
}

void resamplePixel(const ResampleRow& row, int p) {
    const int s = row.source[p];
    const bool hole = s < 0 || row.inverse[s] == 0.0f;
    row.holes[p] = hole ? 255 : 0;
    row.color[p] = 0;
    row.depth[p] = 0;
    if (hole) return;
    const float t = ((static_cast<float>(p) + 0.5f) - row.column[s]) * row.inverse[s];
    row.color[p] = row.cubic ? cubicPacked(row.leftColor + s - 1, t)
                             : lerpPacked(row.leftColor[s], row.leftColor[s + 1], t);
    const float a = row.leftDepth[s], b = row.leftDepth[s + 1];
    row.depth[p] = row.surface && !std::isinf(a) ? a + t * (b - a) : std::min(a, b);
}

}  // namespace

void resampleRowOracle(const ResampleRow& row) {
    const std::vector<bool> survives = findSurvivors(row);
    findInverses(row, findLinks(row, survives));
    findSources(row, survives);
    for (int p = 0; p < row.width; ++p) resamplePixel(row, p);
}

}  // namespace stereonav
