#include "terrain/color_texture.h"

#include <algorithm>

#include "engine/base/parallel.h"

namespace stereonav {

ColorTexture::ColorTexture(const Plane<PackedColor>& image, glm::dvec2 gridOrigin, glm::dvec2 gridPerTexel)
    : mWidth(image.width()), mHeight(image.height()), mGridOrigin(gridOrigin), mGridPerTexel(gridPerTexel) {
    std::size_t total = 0;
    for (int k = 0; k < kMaxLevels; ++k) {
        mOffsets.push_back(static_cast<std::int32_t>(total));
        total += static_cast<std::size_t>(widthOf(k) + 1) * (heightOf(k) + 1);
        if (widthOf(k) == 1 && heightOf(k) == 1) break;
    }
    mTexels.resize(total);
    for (int y = 0; y < mHeight; ++y)
        std::copy_n(image.row(mHeight - 1 - y), mWidth,
                    texels(0) + static_cast<std::ptrdiff_t>(y) * (mWidth + 1));
    finish();
}

void ColorTexture::refill(const std::function<void(int y, PackedColor* row)>& fillRow) {
    parallelFor(mHeight,
                [&](int y) { fillRow(y, texels(0) + static_cast<std::ptrdiff_t>(y) * (mWidth + 1)); });
    finish();
}

void ColorTexture::finish() {
    pad(0);
    for (int k = 1; k < levelCount(); ++k) {
        halve(k);
        pad(k);
    }
}

void ColorTexture::pad(int k) {
    const int width = widthOf(k), height = heightOf(k);
    const std::ptrdiff_t stride = width + 1;
    for (int y = 0; y < height; ++y) texels(k)[y * stride + width] = texels(k)[y * stride + width - 1];
    std::copy_n(texels(k) + (height - 1) * stride, stride, texels(k) + height * stride);
}

void ColorTexture::halve(int k) {
    const Level fine = level(k - 1);
    const int width = widthOf(k);
    parallelFor(heightOf(k), [&](int y) {
        const PackedColor* south = fine.row(2 * y);
        const PackedColor* north = fine.row(std::min(2 * y + 1, fine.height() - 1));
        PackedColor* out = texels(k) + static_cast<std::ptrdiff_t>(y) * (width + 1);
        for (int x = 0; x < width; ++x) {
            const int x0 = 2 * x, x1 = std::min(2 * x + 1, fine.width() - 1);
            out[x] = packColor(0.25f * (unpackColor(south[x0]) + unpackColor(south[x1]) +
                                        unpackColor(north[x0]) + unpackColor(north[x1])));
        }
    });
}

}  // namespace stereonav
