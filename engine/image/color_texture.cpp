#include "engine/image/color_texture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

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

glm::vec3 ColorTexture::rootAt(int k, const glm::dvec2& texel) const {
    const Level texels = level(k);
    const glm::dvec2 place = texel / std::ldexp(1.0, k) - 0.5;
    const glm::dvec2 low =
        glm::clamp(glm::floor(place), glm::dvec2(0.0), glm::dvec2(texels.width() - 1, texels.height() - 1));
    const glm::vec2 s(glm::clamp(place - low, 0.0, 1.0));
    const int i = static_cast<int>(low.x), j = static_cast<int>(low.y);
    const auto root = [](PackedColor c) {
        return glm::vec3(c & 1023u, c >> 10 & 1023u, c >> 20 & 1023u) / 1023.0f;
    };
    const PackedColor *south = texels.row(j) + i, *north = texels.row(j + 1) + i;
    return glm::mix(glm::mix(root(south[0]), root(south[1]), s.x),
                    glm::mix(root(north[0]), root(north[1]), s.x), s.y);
}

glm::vec3 ColorTexture::at(const glm::dvec2& grid, double level) const {
    const glm::dvec2 texel = (grid - mGridOrigin) / mGridPerTexel;
    level = std::clamp(level, 0.0, levelCount() - 1.0);
    const int fine = static_cast<int>(level);
    const double share = std::clamp(2 * (level - fine) - 0.5, 0.0, 1.0);
    glm::vec3 root = rootAt(fine, texel);
    if (share > 0)
        root = glm::mix(root, rootAt(std::min(fine + 1, levelCount() - 1), texel), static_cast<float>(share));
    return root * root;
}

TextureData ColorTexture::forKernels(const glm::dvec2& origin, const glm::dvec2& spacing) const {
    TextureData t;
    t.texels = mTexels.data();
    t.levels = levelCount();
    t.width = mWidth;
    t.height = mHeight;
    for (int k = 0; k < kMaxLevels; ++k)
        t.offset[k] = mOffsets[static_cast<std::size_t>(std::min(k, t.levels - 1))];
    const glm::dvec2 texel = mGridPerTexel * spacing;  // metres
    const glm::dvec2 scale = 1.0 / texel, shift = -(origin + mGridOrigin * spacing) * scale;
    t.scaleX = static_cast<float>(scale.x);
    t.scaleY = static_cast<float>(scale.y);
    t.shiftX = static_cast<float>(shift.x);
    t.shiftY = static_cast<float>(shift.y);
    t.texelsPerMetre = static_cast<float>(1 / std::sqrt(texel.x * texel.y));
    return t;
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
