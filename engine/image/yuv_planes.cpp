#include "engine/image/yuv_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kYuvShift = 16;  // bits of weights; sums of eight weighted bytes stay below 2^28
constexpr int kPairShift = 3;  // eight parts make a pair: four to a row

struct YuvWeights {
    std::array<int, 3> y, u, v;  // weights of r, g, b
    std::array<int, 3> columns;  // weights of a pair's columns: the one before its own two, and these
    int black;
};

YuvWeights weightsOf(YuvRule rule) {
    const bool video = rule == YuvRule::Bt709;
    const double red = video ? 0.2126 : 0.299, blue = video ? 0.0722 : 0.114;
    const double luma = video ? 219.0 / 255 : 1.0, chroma = video ? 224.0 / 255 : 1.0;
    const auto scaled = [](double weight) {
        return static_cast<int>(std::lround(weight * (1 << kYuvShift)));
    };
    YuvWeights w{};
    w.y = {scaled(luma * red), 0, scaled(luma * blue)};
    w.y[1] = scaled(luma) - w.y[0] - w.y[2];  // so that white is white
    const double toU = chroma / (2 * (1 - blue)), toV = chroma / (2 * (1 - red));
    w.u = {scaled(-toU * red), 0, scaled(toU * (1 - blue))};
    w.v = {scaled(toV * (1 - red)), 0, scaled(-toV * blue)};
    w.u[1] = -w.u[0] - w.u[2];  // so that grey stays grey
    w.v[1] = -w.v[0] - w.v[2];
    w.columns = video ? std::array{1, 2, 1} : std::array{0, 2, 2};
    w.black = video ? 16 : 0;
    return w;
}

// A row's bytes, each channel apart, with one more pixel before it and one behind where its width is odd.
struct ByteRow {
    explicit ByteRow(int width) {
        for (auto& channel : channels) channel.resize(static_cast<std::size_t>(width + width % 2) + 1);
    }
    void take(const PackedColor* from, int width) {
        const auto& table = srgbByteFromPacked();
        for (int c = 0; c < 3; ++c) {
            std::uint8_t* to = channels[c].data();
            for (int x = 0; x < width; ++x) to[x + 1] = table[from[x] >> (10 * c) & 1023u];
            to[0] = to[1];
            if (width % 2) to[width + 1] = to[width];
        }
    }
    std::array<std::vector<std::uint8_t>, 3> channels;
};

void writeLuma(const ByteRow& row, const YuvWeights& w, std::uint8_t* to, int width) {
    const std::uint8_t *r = row.channels[0].data() + 1, *g = row.channels[1].data() + 1,
                       *b = row.channels[2].data() + 1;
    const int offset = (w.black << kYuvShift) + (1 << (kYuvShift - 1));
    for (int x = 0; x < width; ++x)
        to[x] =
            static_cast<std::uint8_t>((w.y[0] * r[x] + w.y[1] * g[x] + w.y[2] * b[x] + offset) >> kYuvShift);
}

void writePairs(const ByteRow& upper, const ByteRow& lower, const YuvWeights& w, std::uint8_t* u,
                std::uint8_t* v, int pairs) {
    constexpr int kShift = kYuvShift + kPairShift;
    constexpr int kOffset = (128 << kShift) + (1 << (kShift - 1));
    const auto sum = [&](int channel, int x) {
        const std::uint8_t *a = upper.channels[channel].data() + x, *b = lower.channels[channel].data() + x;
        return w.columns[0] * (a[0] + b[0]) + w.columns[1] * (a[1] + b[1]) + w.columns[2] * (a[2] + b[2]);
    };
    const auto byte = [](int value) {
        return static_cast<std::uint8_t>(std::clamp(value >> kShift, 0, 255));
    };
    for (int n = 0; n < pairs; ++n) {
        const int r = sum(0, 2 * n), g = sum(1, 2 * n), b = sum(2, 2 * n);
        u[n] = byte(w.u[0] * r + w.u[1] * g + w.u[2] * b + kOffset);
        v[n] = byte(w.v[0] * r + w.v[1] * g + w.v[2] * b + kOffset);
    }
}

}  // namespace

void yuvFromPlane(const Plane<PackedColor>& picture, YuvRule rule, const YuvPlanes& to) {
    const YuvWeights w = weightsOf(rule);
    const int width = picture.width(), height = picture.height(), pairs = (width + 1) / 2;
    parallelFor((height + 1) / 2, [&](int j) {
        ByteRow upper(width), lower(width);
        upper.take(picture.row(2 * j), width);
        lower.take(picture.row(std::min(2 * j + 1, height - 1)), width);
        std::uint8_t* const luma = to.y + j * (2 * to.yStride);
        writeLuma(upper, w, luma, 2 * pairs);
        writeLuma(lower, w, luma + to.yStride, 2 * pairs);
        writePairs(upper, lower, w, to.u + j * to.uStride, to.v + j * to.vStride, pairs);
    });
}

void bgr0FromPlane(const Plane<PackedColor>& picture, std::uint8_t* to, std::ptrdiff_t stride, int width,
                   int height) {
    const auto& table = srgbByteFromPacked();
    parallelFor(height, [&](int y) {
        const PackedColor* from = picture.row(std::min(y, picture.height() - 1));
        std::uint8_t* pixel = to + y * stride;
        for (int x = 0; x < width; ++x, pixel += 4) {
            const PackedColor color = from[std::min(x, picture.width() - 1)];
            pixel[0] = table[color >> 20 & 1023u];
            pixel[1] = table[color >> 10 & 1023u];
            pixel[2] = table[color & 1023u];
            pixel[3] = 255;
        }
    });
}

}  // namespace stereonav
