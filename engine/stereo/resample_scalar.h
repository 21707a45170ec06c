// Included by resample_kernel.cpp only: the inverse warp in plain loops without memory of its own, for
// processors without wide vectors. `resample` has internal linkage: each instruction set has its own.
#pragma once

#include <cstdint>

#include "engine/stereo/warp_row.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr float kInfinity = __builtin_inff();

inline int scaled(int difference, int weight) {
    return (difference * weight + 16384) >> 15;
}

inline int rounded(float value) {
    return static_cast<int>(__builtin_lrintf(value));
}

inline int channelOf(std::uint32_t color, int shift) {
    return static_cast<int>(color >> shift & 1023u) << 4;
}

inline std::uint32_t packedChannel(int value, int shift) {
    const int limited = value < 0 ? 0 : value > 1023 * 16 ? 1023 * 16 : value;
    return static_cast<std::uint32_t>((limited + 8) >> 4) << shift;
}

inline float limitedWeight(float weight) {
    return weight < 32767.0f ? weight : 32767.0f;
}

inline std::uint32_t lerp(std::uint32_t a, std::uint32_t b, float t) {
    const int weight = rounded(limitedWeight(t * 32768.0f));
    std::uint32_t result = 0;
    for (int shift = 0; shift < 30; shift += 10) {
        const int first = channelOf(a, shift);
        result |= packedChannel(first + scaled(channelOf(b, shift) - first, weight), shift);
    }
    return result;
}

inline std::uint32_t cubic(const std::uint32_t* taps, float t) {
    const float t2 = t * t;
    const float t3 = t2 * t;
    const int before = rounded(((t2 - 0.5f * t3) - 0.5f * t) * 32768.0f);
    const int second = rounded(limitedWeight(((2.0f * t2 - 1.5f * t3) + 0.5f * t) * 32768.0f));
    const int after = rounded((0.5f * t3 - 0.5f * t2) * 32768.0f);
    std::uint32_t result = 0;
    for (int shift = 0; shift < 30; shift += 10) {
        const int first = channelOf(taps[1], shift);
        const int sum = first + scaled(channelOf(taps[0], shift) - first, before) +
                        scaled(channelOf(taps[2], shift) - first, second) +
                        scaled(channelOf(taps[3], shift) - first, after);
        result |= packedChannel(sum, shift);
    }
    return result;
}

// Columns from the left (vectorised by the compiler), then survivors from the right.
inline void findSurvivors(const ResampleRow& row) {
    for (int i = 0; i < row.width; ++i)
        row.column[i] = (static_cast<float>(i) + 0.5f) + (row.shift - row.scale / row.leftDepth[i]);
    float leftmost = kInfinity;
    for (int i = row.width - 1; i >= 0; --i) {
        const bool survives = row.column[i] < leftmost;
        row.survivors[i] = survives;
        leftmost = survives ? row.column[i] : leftmost;
    }
}

inline bool wide(const ResampleRow& row, int i) {
    const float depth = row.leftDepth[i];
    return row.leftSpread && row.scale * row.leftSpread[i] > (row.mostSpread * depth) * depth;
}

inline void findLinks(const ResampleRow& row) {
    for (int i = 0; i + 1 < row.width; ++i) {
        const float gap = row.column[i + 1] - row.column[i];
        const bool alike = (row.leftDepth[i] < kInfinity) == (row.leftDepth[i + 1] < kInfinity);
        row.links[i] = static_cast<std::uint16_t>(row.survivors[i] & row.survivors[i + 1] &
                                                  (gap >= row.minStretch) & (gap <= row.maxStretch) &
                                                  (alike | !row.surface) & !wide(row, i) & !wide(row, i + 1));
    }
    row.links[row.width - 1] = 0;
}

inline void findInverses(const ResampleRow& row) {
    for (int i = 0; i < row.width; ++i) {
        bool holds = row.links[i] != 0;
        if (holds && row.reach > 0) holds = row.links[i + 1];
        if (holds && row.reach > 1) holds = i > 0 && row.links[i - 1];
        row.inverse[i] = holds ? 1.0f / (row.column[i + 1] - row.column[i]) : 0.0f;
    }
}

inline void findSources(const ResampleRow& row) {
    for (int p = 0; p < row.width; ++p) row.source[p] = -1;
    const float width = static_cast<float>(row.width);
    for (int i = 0; i < row.width; ++i) {
        const float first = __builtin_ceilf(row.column[i] - 0.5f);
        if (row.survivors[i] && first < width) row.source[first > 0.0f ? static_cast<int>(first) : 0] = i;
    }
}

inline void resample(const ResampleRow& row) {
    findSurvivors(row);
    findLinks(row);
    findInverses(row);
    findSources(row);
    int s = -1;
    for (int p = 0; p < row.width; ++p) {
        s = row.source[p] > s ? row.source[p] : s;
        row.source[p] = s;
        const bool hole = s < 0 || row.inverse[s] == 0.0f;
        row.holes[p] = hole ? 255 : 0;
        row.color[p] = 0;
        row.depth[p] = 0;
        if (hole) continue;
        const float t = ((static_cast<float>(p) + 0.5f) - row.column[s]) * row.inverse[s];
        row.color[p] =
            row.cubic ? cubic(row.leftColor + s - 1, t) : lerp(row.leftColor[s], row.leftColor[s + 1], t);
        const float a = row.leftDepth[s], b = row.leftDepth[s + 1];
        row.depth[p] = row.surface && a < kInfinity ? a + t * (b - a) : b < a ? b : a;
    }
}

}  // namespace
}  // namespace stereonav::STEREONAV_ISA
