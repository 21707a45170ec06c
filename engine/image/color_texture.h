// A colour over an extent: an image with its mip levels, ready for bilinear lookup by a footprint.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/image/texture_data.h"

namespace stereonav {

// Levels halve (rounding up) down to 1 x 1, averaged in linear light; texel (i, j) of level k covers
// the 2^k x 2^k texels of level 0 from (i, j) * 2^k on. Texel (0, 0) is south-west, as the
// heightfield's samples: x counts east, y counts north. All levels lie in one array; each has one more
// column and row than texels, which repeat the last, so that a bilinear lookup needs no test.
class ColorTexture {
public:
    static constexpr int kMaxLevels = 16;

    // One level: texel (x, y) is row(y)[x].
    class Level {
    public:
        Level(const PackedColor* texels, int width, int height)
            : mTexels(texels), mWidth(width), mHeight(height) {}
        int width() const { return mWidth; }
        int height() const { return mHeight; }
        int stride() const { return mWidth + 1; }  // texels from a row to the next
        const PackedColor* row(int y) const { return mTexels + static_cast<std::ptrdiff_t>(y) * stride(); }
        const PackedColor& at(int x, int y) const { return row(y)[x]; }
        std::size_t byteCount() const {
            return sizeof(PackedColor) * stride() * (static_cast<std::size_t>(mHeight) + 1);
        }

    private:
        const PackedColor* mTexels;
        int mWidth, mHeight;
    };

    ColorTexture() = default;
    // image: row 0 northernmost, as files have it, at most 32768 texels a side. gridOrigin: grid
    // coordinates of the outer corner of the south-west texel; gridPerTexel: grid units a texel.
    ColorTexture(const Plane<PackedColor>& image, glm::dvec2 gridOrigin, glm::dvec2 gridPerTexel);

    // Writes all of level 0 anew, row by row from several threads, and averages the other levels from it; the
    // memory stays where it is. No one may read meanwhile.
    void refill(const std::function<void(int y, PackedColor* row)>& fillRow);

    // Returns the linear RGB, 0 to 1, at a grid coordinate; beyond the edge the edge's texels are repeated.
    // level: 0 is the finest; clamped to the existing levels. Bilinear in texels as they are stored; from one
    // level to the next it blends over the middle half of the interval. The plain definition of what kernels
    // and shaders compute.
    glm::vec3 at(const glm::dvec2& grid, double level) const;
    // Returns the texture for kernels, which address it by places that lie at the grid coordinates (place -
    // origin) / spacing. The texture must outlive the result.
    TextureData forKernels(const glm::dvec2& origin, const glm::dvec2& spacing) const;

    int levelCount() const { return static_cast<int>(mOffsets.size()); }
    Level level(int k) const { return {mTexels.data() + mOffsets[k], widthOf(k), heightOf(k)}; }
    std::int32_t offset(int k) const { return mOffsets[k]; }  // texels from data() to level k
    const PackedColor* data() const { return mTexels.data(); }
    // Level-0 texel coordinates (continuous, centre of texel 0 at 0.5) = (grid - origin) / perTexel.
    glm::dvec2 gridOrigin() const { return mGridOrigin; }
    glm::dvec2 gridPerTexel() const { return mGridPerTexel; }
    std::size_t byteCount() const { return mTexels.size() * sizeof(PackedColor); }

private:
    int widthOf(int k) const { return (mWidth + (1 << k) - 1) >> k; }
    int heightOf(int k) const { return (mHeight + (1 << k) - 1) >> k; }
    glm::vec3 rootAt(int k, const glm::dvec2& texel) const;
    PackedColor* texels(int k) { return mTexels.data() + mOffsets[k]; }
    void pad(int k);
    void halve(int k);
    void finish();

    int mWidth = 0, mHeight = 0;
    std::vector<std::int32_t> mOffsets;
    std::vector<PackedColor> mTexels;
    glm::dvec2 mGridOrigin{0.0}, mGridPerTexel{1.0};
};

}  // namespace stereonav
