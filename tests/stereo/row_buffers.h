// One row of the left eye and all that its warps write, owned.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/image/plane.h"
#include "engine/stereo/splat_row.h"
#include "engine/stereo/warp_row.h"

namespace stereonav {

constexpr float kSky = std::numeric_limits<float>::infinity();

inline std::uint32_t gray(int level) {
    return static_cast<std::uint32_t>(level) * 0x00100401u;
}

struct RowBuffers {
    explicit RowBuffers(int w)
        : width(w), leftColor(w, 1), color(w, 1), leftDepth(w, 1), depth(w, 1), spread(w, 1), holes(w, 1) {
        for (auto* floats : {&column, &inverse}) floats->assign(w + kRowPadding, 0.0f);
        source.assign(w + kRowPadding, 0);
        accumulators.assign(splatScratchSize(w), 0.0f);
    }
    ResampleRow resample(float shift, float scale, bool cubic, int reach = 2, bool surface = false,
                         float minStretch = 0.5f, float maxStretch = 1.1f) {
        return {leftColor.row(0),
                leftDepth.row(0),
                color.row(0),
                depth.row(0),
                holes.row(0),
                width,
                leftColor.stride(),
                shift,
                scale,
                minStretch,
                maxStretch,
                reach,
                cubic,
                column.data(),
                inverse.data(),
                source.data(),
                surface};
    }
    SplatRow splat(float shift, float scale, float threshold = 0.5f) {
        return {leftColor.row(0),
                leftDepth.row(0),
                color.row(0),
                depth.row(0),
                holes.row(0),
                width,
                shift,
                scale,
                threshold,
                accumulators.data(),
                source.data()};
    }
    PaintRow paint(float shift, float scale) {
        return {
            leftColor.row(0), leftDepth.row(0), color.row(0), depth.row(0), holes.row(0), width, shift, scale,
            source.data()};
    }
    bool hole(int p) const { return holes.at(p, 0) != 0; }

    int width;
    Plane<std::uint32_t> leftColor, color;
    Plane<float> leftDepth, depth, spread;
    Plane<std::uint8_t> holes;
    std::vector<float> column, inverse, accumulators;
    std::vector<std::int32_t> source;
};

}  // namespace stereonav
