// Colours of videos against the formulas of BT.709 and JPEG, worked out in floating point.
#include "engine/image/yuv_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stereonav {
namespace {

struct YuvBytes {
    YuvBytes(const Plane<PackedColor>& picture, YuvRule rule)
        : width(picture.width() + picture.width() % 2), height(picture.height() + picture.height() % 2) {
        // one more of each row, which must stay as it is
        y.assign(static_cast<std::size_t>((width + 1) * height), 7);
        u.assign(static_cast<std::size_t>((width / 2 + 1) * height / 2), 7);
        v = u;
        yuvFromPlane(picture, rule, {y.data(), u.data(), v.data(), width + 1, width / 2 + 1, width / 2 + 1});
    }
    int width, height;
    std::vector<std::uint8_t> y, u, v;
};

Plane<PackedColor> pictureOf(int width, int height, int step) {
    Plane<PackedColor> picture(width, height);
    const auto& table = packedFromSrgbByte();
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            picture.at(i, j) = static_cast<PackedColor>(table[(step * i * i + 40 * j) % 256] |
                                                        table[(90 * i + step * j) % 256] << 10 |
                                                        table[(255 - step * i + 17 * j * j) & 255] << 20);
    return picture;
}

double channelAt(const Plane<PackedColor>& picture, int x, int y, int c) {
    const PackedColor color =
        picture.at(std::clamp(x, 0, picture.width() - 1), std::clamp(y, 0, picture.height() - 1));
    return srgbByteFromPacked()[color >> (10 * c) & 1023u];
}

// Row and column of a pair of differences; weights of the columns from the one before its own two.
double meanAt(const Plane<PackedColor>& picture, int i, int j, int c, const std::vector<double>& columns) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        for (int row = 0; row < 2; ++row)
            sum +=
                columns[static_cast<std::size_t>(k)] * channelAt(picture, 2 * i - 1 + k, 2 * j + row, c) / 2;
    return sum;
}

void expectFormula(const Plane<PackedColor>& picture, YuvRule rule) {
    const YuvBytes found(picture, rule);
    const bool video = rule == YuvRule::Bt709;
    const double kr = video ? 0.2126 : 0.299, kb = video ? 0.0722 : 0.114;
    const double luma = video ? 219.0 / 255 : 1, chroma = video ? 224.0 / 255 : 1, black = video ? 16 : 0;
    const std::vector<double> columns = video ? std::vector{0.25, 0.5, 0.25} : std::vector{0.0, 0.5, 0.5};
    const auto lumaOf = [&](double r, double g, double b) { return kr * r + (1 - kr - kb) * g + kb * b; };
    for (int j = 0; j < found.height; ++j) {
        for (int i = 0; i < found.width; ++i) {
            const double y = black + luma * lumaOf(channelAt(picture, i, j, 0), channelAt(picture, i, j, 1),
                                                   channelAt(picture, i, j, 2));
            EXPECT_NEAR(found.y[static_cast<std::size_t>(j * (found.width + 1) + i)], y, 0.51)
                << i << ' ' << j;
        }
        EXPECT_EQ(found.y[static_cast<std::size_t>(j * (found.width + 1) + found.width)], 7)
            << "behind a row";
    }
    for (int j = 0; j < found.height / 2; ++j)
        for (int i = 0; i < found.width / 2; ++i) {
            const double r = meanAt(picture, i, j, 0, columns), g = meanAt(picture, i, j, 1, columns),
                         b = meanAt(picture, i, j, 2, columns), y = lumaOf(r, g, b);
            const auto at = static_cast<std::size_t>(j * (found.width / 2 + 1) + i);
            EXPECT_NEAR(found.u[at], std::min(255.0, 128 + chroma * (b - y) / (2 * (1 - kb))), 0.51);
            EXPECT_NEAR(found.v[at], std::min(255.0, 128 + chroma * (r - y) / (2 * (1 - kr))), 0.51);
        }
}

TEST(YuvPlanes, FollowTheFormulasInAnySize) {
    for (const YuvRule rule : {YuvRule::Bt709, YuvRule::Jfif})
        for (const auto& [width, height] : {std::pair(1, 1), {2, 2}, {3, 5}, {5, 2}, {1, 8}, {37, 19}}) {
            SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
            expectFormula(pictureOf(width, height, 3), rule);
        }
}

TEST(YuvPlanes, EndsOfTheScaleAreMet) {
    struct Case {
        PackedColor color;
        int y709, u709, v709, yJfif, uJfif, vJfif;
    };
    constexpr PackedColor kRed = 1023u, kBlue = 1023u << 20, kWhite = 0x3FFFFFFFu;
    for (const Case& one : {Case{0, 16, 128, 128, 0, 128, 128}, Case{kWhite, 235, 128, 128, 255, 128, 128},
                            Case{kRed, 63, 102, 240, 76, 85, 255}, Case{kBlue, 32, 240, 118, 29, 255, 107}}) {
        Plane<PackedColor> picture(2, 2);
        for (int n = 0; n < 4; ++n) picture.at(n % 2, n / 2) = one.color;
        const YuvBytes video(picture, YuvRule::Bt709), jpeg(picture, YuvRule::Jfif);
        EXPECT_EQ(video.y[0], one.y709);
        EXPECT_EQ(video.u[0], one.u709);
        EXPECT_EQ(video.v[0], one.v709);
        EXPECT_EQ(jpeg.y[0], one.yJfif);
        EXPECT_EQ(jpeg.u[0], one.uJfif);
        EXPECT_EQ(jpeg.v[0], one.vJfif);
    }
}

TEST(YuvPlanes, FourBytesAPixelAreThoseOfFiles) {
    const Plane<PackedColor> picture = pictureOf(5, 3, 7);
    std::vector<std::uint8_t> bytes(4 * 28, 7);
    bgr0FromPlane(picture, bytes.data(), 28, 6, 4);  // one column and row more than there are
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 6; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(bytes[static_cast<std::size_t>(28 * j + 4 * i + 2 - c)],
                          channelAt(picture, i, j, c));
        EXPECT_EQ(bytes[static_cast<std::size_t>(28 * j + 24)], 7);
    }
}

}  // namespace
}  // namespace stereonav
