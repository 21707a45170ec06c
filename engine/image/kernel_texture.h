// Colours of packets of places in a texture. Texels are mixed as they are stored, as square roots of linear
// light, in 14-bit fixed point; the mip levels themselves are averaged in linear light. What ColorTexture::at
// says. Included by kernels only.
#pragma once

#include "engine/image/texture_data.h"
#include "engine/simd/simd.h"

namespace stereonav::STEREONAV_ISA {

// A packed colour opened into 16-bit halves, each channel times 16: red and blue, and green.
struct ColorHalves {
    I redBlue, green;
};

// Opens packed colours into halves, and closes halves into packed colours, rounding to nearest.
STEREONAV_INLINE ColorHalves openColor(I packed) {
    return {(shiftLeft<4>(packed) & I(0x3FF0)) | (packed & I(0x3FF00000)), shiftRight<6>(packed) & I(0x3FF0)};
}

STEREONAV_INLINE I closeColor(ColorHalves c) {
    const I redBlue = c.redBlue + I(0x00080008), green = c.green + I(8);
    return (shiftRight<4>(redBlue) & I(0x3FF)) | (redBlue & I(0x3FF00000)) |
           (shiftLeft<6>(green) & I(0xFFC00));
}

// Mixes a and b; weight: halvesOfWeight() of b's share.
STEREONAV_INLINE ColorHalves mix(ColorHalves a, ColorHalves b, I weight) {
    return {lerpHalves(a.redBlue, b.redBlue, weight), lerpHalves(a.green, b.green, weight)};
}

// Returns weights in [0, 1] as 15-bit fixed point in both halves of a lane.
STEREONAV_INLINE I halvesOfWeight(F w) {
    const I fixed = truncateToInt(w * F(32767.0f));
    return fixed | shiftLeft<16>(fixed);
}

// Mixes the texel at `index`, its neighbour and the two in the row above; fractions: 0 to 1. m: lanes to
// read.
STEREONAV_INLINE ColorHalves bilinearColor(const std::uint32_t* texels, I index, I stride, F fractionX,
                                           F fractionY, M m) {
    const float* base = reinterpret_cast<const float*>(texels);
    const FPair south = gatherPair(base, index, m), north = gatherPair(base, index + stride, m);
    const I x = halvesOfWeight(fractionX), y = halvesOfWeight(fractionY);
    return mix(mix(openColor(asInt(south.first)), openColor(asInt(south.second)), x),
               mix(openColor(asInt(north.first)), openColor(asInt(north.second)), x), y);
}

// Returns the colours of a level, 0 to levels - 1. x, y: level-0 texel coordinates, texel centres at halves.
STEREONAV_INLINE ColorHalves colorInLevel(const TextureData& texture, F x, F y, I level, M m) {
    const I one = shiftLeft(I(1), level);
    const I width = shiftRight(I(texture.width - 1) + one, level);
    const I height = shiftRight(I(texture.height - 1) + one, level);
    const F scale = asFloat(shiftLeft<23>(I(127) - level));  // 2^-level
    const F tx = mulAdd(x, scale, F(-0.5f)), ty = mulAdd(y, scale, F(-0.5f));
    const I i = clamp(floorToInt(tx), I(0), width - I(1)), j = clamp(floorToInt(ty), I(0), height - I(1));
    const F fx = clamp(tx - toFloat(i), F(0.0f), F(1.0f)), fy = clamp(ty - toFloat(j), F(0.0f), F(1.0f));
    const I stride = width + I(1);
    return bilinearColor(texture.texels, lookup16(texture.offset, level) + j * stride + i, stride, fx, fy, m);
}

// Returns the colours at places in TextureData's coordinates; level: 0 to levels - 1, with fractions.
STEREONAV_INLINE ColorHalves textureColor(const TextureData& texture, F placeX, F placeY, F level, M m) {
    const F x = mulAdd(placeX, F(texture.scaleX), F(texture.shiftX));
    const F y = mulAdd(placeY, F(texture.scaleY), F(texture.shiftY));
    // The step from one level to the next is taken in the middle half between them: outside it one level
    // is enough, and neighbours mostly agree on which.
    const F nearest =
        clamp(mulAdd(level - toFloat(truncateToInt(level)), F(2.0f), F(-0.5f)), F(0.0f), F(1.0f));
    const M whole = nearest >= F(1.0f);
    const I fine = truncateToInt(level) + select(whole, I(1), I(0));
    const F fraction = select(whole, F(0.0f), nearest);
    const ColorHalves sharp = colorInLevel(texture, x, y, fine, m);
    const M between = m & (fraction > F(0.0f));
    if (!any(between)) return sharp;
    const I coarse = min(fine + I(1), I(texture.levels - 1));
    return mix(sharp, colorInLevel(texture, x, y, coarse, between), halvesOfWeight(fraction));
}

}  // namespace stereonav::STEREONAV_ISA
