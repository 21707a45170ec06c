// Surfaces in a grid without layers or noise, shaded at 4 x 4 places of a patch of pixels and interpolated
// between them (f_s of V3 of docs/volume_light.md) where the places lie close enough together; else at each
// sample. Places are weighted by the length of their gradient, so that places beside a surface, where it is
// near 0, do not darken it. Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_arriving.h"
#include "engine/medium/sweep/kernel_eye_rays.h"
#include "engine/medium/sweep/kernel_table_window.h"

namespace stereonav::STEREONAV_ISA {

// Places of a patch, which is half a tile, 16 x 8 pixels, or one of its two halves: at the centres of its
// outermost pixels, and evenly between.
struct ShadingPatch {
    static constexpr int kSide = 4, kPlaces = 16, kPackets = kPlaces / kLanes, kHeight = EyeTile::kHalf;
    EyeRays rays[kPackets];
    V3 toEye[kPackets];
};
// Shades of a slab at the places of a patch.
struct ShadedPlaces {
    float length[ShadingPatch::kPlaces];   // the gradient's length
    float weighed[ShadingPatch::kPlaces];  // that length times the shade by Blinn-Phong
};

// Shades for the half of a tile that is being walked, computed when the first sample of a slab needs them.
class TileShading {
public:
    STEREONAV_INLINE TileShading(const SweepScene& scene, const SweepEye& eye, const SweepChunk& chunk,
                                 const EyeTile& tile)
        : mScene(scene), mEye(eye), mChunk(chunk), mTile(tile) {}

    // Finds the gradient's length and the shade by Blinn-Phong in slab n of the chunk, for lanes m of the
    // packet at (x, y) of the tile. Returns false where the places are too far apart, or where only some have
    // a gradient, since Blinn-Phong jumps between them.
    STEREONAV_INLINE bool at(int n, int x, int y, M m, F& length, F& shade) {
        const int width = widthFor(n);
        if (width == 0) return false;
        enterHalf(y / ShadingPatch::kHeight * ShadingPatch::kHeight);
        const int number = width == EyeTile::kHalf ? x / width : 0;
        ShadedPlaces& places = mPlaces[number][n];
        if (!(mShaded[number] >> n & 1u)) {
            mShaded[number] |= 1u << n;
            shadePlaces(n, width, number, places);
        }
        const I lane = laneIndex();
        const float perPixel = 3.0f / static_cast<float>(width - 1);
        const F u = toFloat((lane & I(3)) + I(x % width)) * F(perPixel),
                v = toFloat(shiftRight<2>(lane) + I(y - mTop)) * F(3.0f / (ShadingPatch::kHeight - 1));
        const I column = min(truncateToInt(u), I(2)), row = min(truncateToInt(v), I(2));
        const F one(1.0f), s = min(u - toFloat(column), one), t = min(v - toFloat(row), one);
        const I place = shiftLeft<2>(row) + column;
        // Only sums of numbers that are not negative: differences would leave rounding errors, which would
        // then be divided by small numbers.
        const F left = one - s, above = one - t;
        const F weights[4] = {left * above, s * above, left * t, s * t};
        struct AtCorners {
            F f[4];
        };
        const auto cornersOf = [&](const float* numbers) {
            const auto read = [&](int away) {
                return asFloat(lookup16(reinterpret_cast<const std::int32_t*>(numbers), place + I(away)));
            };
            return AtCorners{{read(0), read(1), read(4), read(5)}};
        };
        const auto between = [&](const AtCorners& c) {
            return mulAdd(weights[0], c.f[0],
                          mulAdd(weights[1], c.f[1], mulAdd(weights[2], c.f[2], weights[3] * c.f[3])));
        };
        const AtCorners lengths = cornersOf(places.length);
        length = between(lengths);
        const F least = min(min(lengths.f[0], lengths.f[1]), min(lengths.f[2], lengths.f[3]));
        if (any(m & (least <= F(0.0f)) & (length > F(0.0f)))) return false;
        shade = between(cornersOf(places.weighed)) * approxReciprocal(max(length, F(1e-30f)));
        return true;
    }

private:
    STEREONAV_INLINE void enterHalf(int top) {
        if (top == mTop) return;
        mTop = top;
        mRays = mShaded[0] = mShaded[1] = 0;
    }

    // Returns the width in pixels of the patch whose places lie close enough together in slab n; 0: none.
    STEREONAV_INLINE int widthFor(int n) {
        if (!mMeasured) measure();
        const double away = mChunk.middle[n] + (mChunk.reference - mEye.start);
        const double most = static_cast<double>(mScene.shadingWidth) * mScene.shadingWidth / (away * away);
        if (mLargestStep[0] <= most) return EyeTile::kSide;
        return mLargestStep[1] <= most ? EyeTile::kHalf : 0;
    }

    // Measures the distances between places at the tile's middle: squares, in voxels, per metre along the
    // axis from the eye.
    [[gnu::noinline]] void measure() {
        mMeasured = true;
        constexpr double kMiddle = EyeTile::kSide / 2;
        const double wx = mEye.xMin + (mTile.x0 + kMiddle) * mEye.perX,
                     wy = mEye.yMax - (mTile.y0 + kMiddle) * mEye.perY;
        const double perAlong = 1 / (mEye.axis[2] + mEye.axis[0] * wx + mEye.axis[1] * wy);
        double x[3], y[3];  // from a pixel to the next
        for (int k = 0; k < 3; ++k) {
            const double way = (mEye.ahead[k] + mEye.right[k] * wx + mEye.up[k] * wy) * perAlong;
            x[k] = (mEye.right[k] - way * mEye.axis[0]) * perAlong * mEye.perX;
            y[k] = (mEye.up[k] - way * mEye.axis[1]) * perAlong * mEye.perY;
        }
        const auto square = [&](const double(&step)[3]) {
            double sum = 0;
            for (const float(&row)[3] : mScene.grid.fromPlace) {
                const double voxels = row[0] * step[0] + row[1] * step[1] + row[2] * step[2];
                sum += voxels * voxels;
            }
            return sum;
        };
        const auto pixels = [](int size) { return (size - 1) * (size - 1) / 9.0; };
        const double across = square(x), down = square(y) * pixels(ShadingPatch::kHeight);
        const double whole = across * pixels(EyeTile::kSide), half = across * pixels(EyeTile::kHalf);
        mLargestStep[0] = whole > down ? whole : down;
        mLargestStep[1] = half > down ? half : down;
    }

    STEREONAV_INLINE const ShadingPatch& patchOf(int width, int number) {
        const int index = width == EyeTile::kSide ? 0 : 1 + number;
        ShadingPatch& patch = mPatches[index];
        if (mRays >> index & 1u) return patch;
        mRays |= 1u << index;
        const float perX = static_cast<float>(width - 1) / 3, perY = (ShadingPatch::kHeight - 1) / 3.0f;
        const float x0 = static_cast<float>(mTile.x0 + number * width) + 0.5f,
                    y0 = static_cast<float>(mTile.y0 + mTop) + 0.5f;
        for (int k = 0; k < ShadingPatch::kPackets; ++k) {
            const I place = laneIndex() + I(k * kLanes);
            const EyeRays rays =
                eyeRays(mEye, mChunk.reference, mulAdd(toFloat(place & I(3)), F(perX), F(x0)),
                        mulAdd(toFloat(shiftRight<2>(place)), F(perY), F(y0)));
            patch.rays[k] = rays;
            patch.toEye[k] = rays.toEye(mEye);
        }
        return patch;
    }

    // Clamps places beyond the grid's faces to the faces.
    [[gnu::noinline]] void shadePlaces(int n, int width, int number, ShadedPlaces& to) {
        const ShadingPatch& patch = patchOf(width, number);
        const SweepGrid& grid = mScene.grid;
        const SweepLight& light = mScene.light;
        const F zero(0.0f), t(mChunk.middle[n]),
            along(mChunk.middle[n] + static_cast<float>(mChunk.reference));
        for (int k = 0; k < ShadingPatch::kPackets; ++k) {
            const EyeRays& rays = patch.rays[k];
            const V3 place = rays.placeAt(t), there = voxelOf(grid, place);
            const V3 voxel{clamp(there.x, zero, F(grid.last[0])), clamp(there.y, zero, F(grid.last[1])),
                           clamp(there.z, zero, F(grid.last[2]))};
            const V3 g = gridGradient(grid, voxel, rays.valid);
            const Arriving a =
                light.parallel ? sunAt(light, place, rays.valid) : lampAt(light, place, along, rays.valid);
            const F length = lengthOf(g),
                    shade = blinnPhong(mScene.look, worldGradient(grid, g), a.way, patch.toEye[k]);
            store(to.length + k * kLanes, select(rays.valid, length, zero));
            store(to.weighed + k * kLanes, select(rays.valid, length * shade, zero));
        }
    }

    const SweepScene& mScene;
    const SweepEye& mEye;
    const SweepChunk& mChunk;
    const EyeTile& mTile;
    bool mMeasured = false;
    int mTop = -1;
    std::uint32_t mRays = 0, mShaded[2] = {};  // bits of patches; of slabs, by patch
    double mLargestStep[2];                    // largest step of half a tile's patch, and of its halves
    ShadingPatch mPatches[3];
    ShadedPlaces mPlaces[2][SweepChunk::kMost];
};

// Where a packet lies in its tile; null: each sample is shaded itself.
struct PacketShading {
    TileShading* tile = nullptr;
    int x = 0, y = 0;
};

// Input of a sample's shading: its gradient along world axes, or the finished Blinn-Phong shade.
struct SurfaceAlone {
    V3 gradient;
    F shade;
    bool isShaded;
};
// Returns the input of the shading at places in a grid alone whose surface weight is not 0, and sets that
// weight.
[[gnu::noinline]] inline SurfaceAlone surfaceAlone(const SweepGrid& grid, const V3& voxel,
                                                   const TablePlaces& places, const PacketShading& shading,
                                                   int slab, Properties& p) {
    const F zero(0.0f);
    const SweepTable& table = grid.table;
    const F most =
        table.surfacePairs ? places.readPairs(table.surfacePairs) : places.readOne(table.mostSurface);
    const M shaded = places.m & (most > zero);
    p.surface = select(shaded, most, zero);
    SurfaceAlone surface{{zero, zero, zero}, zero, false};
    if (!any(shaded)) return surface;
    F length = zero;
    surface.isShaded =
        shading.tile && shading.tile->at(slab, shading.x, shading.y, shaded, length, surface.shade);
    if (!surface.isShaded) {
        const V3 g = gridGradient(grid, voxel, shaded);
        surface.gradient = worldGradient(grid, g);
        if (table.rows > 1) length = lengthOf(g);
    }
    if (table.sharePairs) {
        const F row = min(length * F(table.perGradient), F(static_cast<float>(table.rows - 1)));
        const I low = min(truncateToInt(row), I(table.rows - 2));
        p.surface = p.surface * betweenHalves(gather(table.sharePairs, low, shaded), row - toFloat(low));
    } else if (table.rows > 1) {
        Column at = places.at;
        setRow(table, length, at);
        p.surface = select(shaded, memberAt(table, table.surface, at, shaded), zero);
    }
    return surface;
}

}  // namespace stereonav::STEREONAV_ISA
