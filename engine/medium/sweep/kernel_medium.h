// Samples a medium at packets of places, in float, as Medium::at() does. sampleAny() handles noise, layers
// and gradients; a grid alone under a one-dimensional table has a faster path (SweepScene::gridAlone).
// Included by kernels only.
#pragma once

#include "engine/image/kernel_texture.h"
#include "engine/medium/sweep/kernel_block.h"
#include "engine/medium/sweep/kernel_heights.h"
#include "engine/medium/sweep/kernel_table.h"
#include "engine/medium/sweep/kernel_table_window.h"
#include "engine/medium/sweep/sweep_kernel_types.h"
#include "engine/volume/kernel_light.h"

namespace stereonav::STEREONAV_ISA {

// Returns whether places, in voxel coordinates, lie within the grid.
STEREONAV_INLINE M insideGrid(const SweepGrid& grid, const V3& v) {
    const F zero(0.0f);
    return (v.x >= zero) & (v.y >= zero) & (v.z >= zero) & (v.x <= F(grid.last[0])) &
           (v.y <= F(grid.last[1])) & (v.z <= F(grid.last[2]));
}
// Returns rows * place + zero.
STEREONAV_INLINE V3 transformed(const float (&rows)[3][3], const float (&zero)[3], const V3& place) {
    const auto row = [&](int k) {
        return mulAdd(place.x, F(rows[k][0]),
                      mulAdd(place.y, F(rows[k][1]), mulAdd(place.z, F(rows[k][2]), F(zero[k]))));
    };
    return {row(0), row(1), row(2)};
}
STEREONAV_INLINE V3 voxelOf(const SweepGrid& grid, const V3& place) {
    return transformed(grid.fromPlace, grid.zero, place);
}

// Indices of the grid cells that hold a packet of places.
struct GridCell {
    I x, y, z;
};
STEREONAV_INLINE GridCell cellOf(const SweepGrid& grid, const V3& v) {
    return {min(truncateToInt(v.x), I(grid.lastCell[0])), min(truncateToInt(v.y), I(grid.lastCell[1])),
            min(truncateToInt(v.z), I(grid.lastCell[2]))};
}
STEREONAV_INLINE F gridValue(const SweepGrid& grid, const V3& v, M m) {
    const auto [x, y, z] = cellOf(grid, v);
    const I high = truncateToInt(mulAdd(v.x - toFloat(x), F(16384.0f), F(0.5f)));
    const I weights = shiftLeft<16>(high) + (I(16384) - high);
    const F fy = v.y - toFloat(y), fz = v.z - toFloat(z);
    const I word = z * I(grid.strideZ) + y * I(grid.strideY) + x;
    const auto pair = [&](std::int64_t offset) {
        return toFloat(dotHalves(gatherHalves(grid.values + offset, word, m), weights));
    };
    const F near = lerp(pair(0), pair(grid.strideY), fy);
    const std::int64_t next = grid.strideZ;
    const F far = lerp(pair(next), pair(next + grid.strideY), fy);
    return lerp(near, far, fz) * F(1.0f / 16384);
}
// Returns what gridValue() does, but faster where the places lie close together.
STEREONAV_INLINE F valueNearby(const SweepGrid& grid, const V3& v, M m) {
    const GridCell cell = cellOf(grid, v);
    F value;
    return blockValue(grid, v, cell.x, cell.y, cell.z, m, value) ? value : gridValue(grid, v, m);
}
// Returns central differences over two voxels along each axis, at places whose cells have other cells on all
// sides. Each row is read as two words, voxels x - 1 and x, and x + 1 and x + 2, from which the word for x
// and x + 1 is put together.
STEREONAV_INLINE V3 innerDifferences(const SweepGrid& grid, const V3& v, I x, I y, I z, M m) {
    const I high = truncateToInt(mulAdd(v.x - toFloat(x), F(16384.0f), F(0.5f)));
    const I weights = shiftLeft<16>(high) + (I(16384) - high);
    const F fy = v.y - toFloat(y), fz = v.z - toFloat(z);
    const I word = z * I(grid.strideZ) + y * I(grid.strideY) + x;
    const auto weighed = [&](I pair) { return toFloat(dotHalves(pair, weights)); };
    const auto wordAt = [&](std::int64_t offset) { return gatherHalves(grid.values + offset, word, m); };
    const std::int64_t down = grid.strideY, next = grid.strideZ;
    F here[4], across[4];
    for (int n = 0; n < 4; ++n) {
        const std::int64_t row = (n & 1 ? down : 0) + (n & 2 ? next : 0);
        const I before = wordAt(row - 1), after = wordAt(row + 1);
        here[n] = weighed((shiftRight<16>(before) & I(0xFFFF)) | shiftLeft<16>(after));
        across[n] = weighed(after) - weighed(before);
    }
    const auto mixed = [&](F a, F b, F c, F d) { return lerp(lerp(a, b, fy), lerp(c, d, fy), fz); };
    const auto at = [&](std::int64_t offset) { return weighed(wordAt(offset)); };
    const F unit(1.0f / 16384);
    return {mixed(across[0], across[1], across[2], across[3]) * unit,
            mixed(here[1] - at(-down), at(2 * down) - here[0], here[3] - at(next - down),
                  at(next + 2 * down) - here[2]) *
                unit,
            mixed(here[2] - at(-next), here[3] - at(down - next), at(2 * next) - here[0],
                  at(2 * next + down) - here[1]) *
                unit};
}
// Returns the gradient in value units a metre, along the grid's own axes. Beyond its faces the grid counts as
// continued with the outermost voxels' values.
[[gnu::noinline]] inline V3 gridGradient(const SweepGrid& grid, const V3& v, M m) {
    const F zero(0.0f), one(1.0f);
    const I x = truncateToInt(v.x), y = truncateToInt(v.y), z = truncateToInt(v.z), first(1);
    const M outer =
        m & ~(within(x - first, I(grid.lastCell[0] - 2)) & within(y - first, I(grid.lastCell[1] - 2)) &
              within(z - first, I(grid.lastCell[2] - 2)));
    const F scale[3] = {F(grid.slope[0]), F(grid.slope[1]), F(grid.slope[2])};
    if (!any(outer)) {
        V3 d;
        if (!blockDifferences(grid, v, x, y, z, m, d)) d = innerDifferences(grid, v, x, y, z, m);
        return {d.x * scale[0], d.y * scale[1], d.z * scale[2]};
    }
    const auto along = [&](int axis) {
        V3 before = v, after = v;
        F& low = axis == 0 ? before.x : axis == 1 ? before.y : before.z;
        F& high = axis == 0 ? after.x : axis == 1 ? after.y : after.z;
        low = max(low - one, zero);
        high = min(high + one, F(grid.last[axis]));
        return (gridValue(grid, after, m) - gridValue(grid, before, m)) * scale[axis];
    };
    return {along(0), along(1), along(2)};
}
STEREONAV_INLINE F lengthOf(const V3& v) {
    return sqrt(dot(v, v));
}

// The four channels of the noise at a place, each in -1..1.
struct NoiseValue {
    F red, green, blue, alpha;
};
// The bytes of a texel as 15-bit halves: red and blue (even), green and alpha (odd).
struct NoiseWords {
    I even, odd;
};
STEREONAV_INLINE NoiseWords openNoise(I word) {
    const I bytes(0x00FF00FF);
    return {shiftLeft<7>(word & bytes), shiftLeft<7>(shiftRight<8>(word) & bytes)};
}
STEREONAV_INLINE NoiseWords mixNoise(const NoiseWords& a, const NoiseWords& b, I t) {
    return {lerpHalves(a.even, b.even, t), lerpHalves(a.odd, b.odd, t)};
}
STEREONAV_INLINE F noiseChannel(I half) {
    return mulAdd(toFloat(half & I(0xFFFF)), F(1.0f / (127.5f * 128)), F(-1.0f));
}
// Returns the noise of one scale at places, interpolated trilinearly.
[[gnu::noinline]] inline NoiseValue noiseAt(const SweepNoise& noise, const SweepNoise::Scale& scale,
                                            const V3& place, M m) {
    const F perMetre(scale.perMetre);
    const F u = mulAdd(place.x, perMetre, F(scale.zero[0])), v = mulAdd(place.y, perMetre, F(scale.zero[1])),
            w = mulAdd(place.z, perMetre, F(scale.zero[2]));
    const I x = floorToInt(u), y = floorToInt(v), z = floorToInt(w), wrap(31), one(1);
    const I tx = weightOf(u - toFloat(x)), ty = weightOf(v - toFloat(y)), tz = weightOf(w - toFloat(z));
    const I x0 = x & wrap, x1 = (x + one) & wrap;
    const auto row = [&](I yy, I zz) {
        const I first = shiftLeft<10>(zz & wrap) + shiftLeft<5>(yy & wrap);
        return mixNoise(openNoise(gather(noise.texels, first + x0, m)),
                        openNoise(gather(noise.texels, first + x1, m)), tx);
    };
    const NoiseWords sum = mixNoise(mixNoise(row(y, z), row(y + one, z), ty),
                                    mixNoise(row(y, z + one), row(y + one, z + one), ty), tz);
    return {noiseChannel(sum.even), noiseChannel(sum.odd), noiseChannel(shiftRight<16>(sum.even)),
            noiseChannel(shiftRight<16>(sum.odd))};
}

// The effect of all scales of the noise at a place: a displacement, and factors on extinction, on colour and
// on the extinction of scattered light.
struct Disturbance {
    V3 way;  // the displacement, metres
    F extinction, color[3], indirect[3];
};
STEREONAV_INLINE Disturbance disturbanceAt(const SweepNoise& noise, const V3& place, M m) {
    const F zero(0.0f), one(1.0f);
    Disturbance d{{zero, zero, zero}, one, {one, one, one}, {one, one, one}};
    for (int n = 0; n < noise.scales; ++n) {
        const SweepNoise::Scale& scale = noise.scale[n];
        const NoiseValue value = noiseAt(noise, scale, place, m);
        d.way.x = mulAdd(F(scale.displacement), value.red, d.way.x);
        d.way.y = mulAdd(F(scale.displacement), value.green, d.way.y);
        d.way.z = mulAdd(F(scale.displacement), value.blue, d.way.z);
        d.extinction = mulAdd(F(scale.extinction), value.alpha, d.extinction);
        for (int k = 0; k < 3; ++k) {
            d.color[k] = mulAdd(F(scale.color[k]), value.red, d.color[k]);
            d.indirect[k] = mulAdd(F(scale.indirect[k]), value.green, d.indirect[k]);
        }
    }
    return d;
}

// A layer's own colours, linear RGB 0..1, as HeightLayer::colorAt() returns them. colorAtPlace() reads them
// for lanes m.
struct PlaceColor {
    F linear[3];
};
[[gnu::noinline]] inline PlaceColor colorAtPlace(const TextureData& texture, const V3& place, F footprint,
                                                 M m) {
    const F zero(0.0f), one(1.0f), scale(1.0f / (1023 * 16));
    const F texels = select(m, footprint * F(texture.texelsPerMetre), one);
    const F level = min(log2(max(texels, one)), F(static_cast<float>(texture.levels - 1)));
    const ColorHalves c = textureColor(texture, select(m, place.x, zero), select(m, place.y, zero), level, m);
    const auto square = [&](I half) {
        const F root = toFloat(half) * scale;
        return root * root;
    };
    const I low(0xFFFF);
    return {{square(c.redBlue & low), square(c.green & low), square(shiftRight<16>(c.redBlue) & low)}};
}

// Adds a layer's properties for lanes m, where the layer has this extinction. read: returns a member of its
// table at these places. tint: factors on the table's colours; null: none.
template <bool kColors, bool kIndirect, typename Read>
STEREONAV_INLINE void addProperties(const SweepTable& table, F extinction, F weight, M m, const Read& read,
                                    const PlaceColor* tint, Properties& sum) {
    const F zero(0.0f);
    sum.extinction = sum.extinction + extinction;
    if constexpr (kIndirect)
        for (int k = 0; k < 3; ++k)
            sum.indirect[k] = mulAdd(select(m, weight, zero), read(table.indirect[k]), sum.indirect[k]);
    if constexpr (kColors) {
        const F share = select(m, extinction / max(sum.extinction, F(1e-30f)), zero);
        for (int k = 0; k < 3; ++k) {
            const F color = read(table.color[k]);
            sum.color[k] = lerp(sum.color[k], tint ? color * tint->linear[k] : color, share);
        }
        sum.surface = lerp(sum.surface, table.surface ? read(table.surface) : zero, share);
        for (int k = 0; k < 3; ++k)
            sum.glow[k] = lerp(sum.glow[k], table.glow[k] ? read(table.glow[k]) : zero, share);
    }
}
// Adds a layer to the properties found so far. Extinctions add up; colours, surface weight and glow are means
// weighted by extinction. The light's pass needs no colours (kColors), and eyes do not always need the
// extinction of scattered light (kIndirect). Layers have no gradient: only a table's first row is read.
// kTinted: the layer has colours of its own.
template <bool kColors, bool kIndirect, bool kTinted>
[[gnu::noinline]] void addLayer(const SweepLayer& layer, const V3& place, F footprint, M m, Properties& sum) {
    const F zero(0.0f), one(1.0f);
    const M near = m & (place.z >= F(layer.lowest)) & (place.z <= F(layer.highest));
    if (!any(near)) return;
    const F height = heightAt(layer, place, footprint, near);
    const F above = (place.z - F(layer.base)) - height;
    const F inside = min(above + F(layer.below), F(layer.above) - above);
    const M in = near & (inside >= zero);
    if (!any(in)) return;
    const F weight = layer.perTaper > 0 ? min(inside * F(layer.perTaper), one) : one;
    const SweepTable& table = layer.table;
    PlaceColor tint;
    const auto tintOf = [&](M counts) -> const PlaceColor* {
        if constexpr (!kTinted) return nullptr;
        tint = colorAtPlace(layer.color, place, footprint, counts);
        return &tint;
    };
    if (table.uniform) {
        const auto first = [](const float* member) { return F(member[0]); };
        const F extinction = select(in, weight * first(table.extinction), zero);
        const M counts = in & (extinction > zero);
        if (any(counts))
            addProperties<kColors, kIndirect>(table, extinction, weight, counts, first, tintOf(counts), sum);
        return;
    }
    TablePlaces places(columnOf(table, select(in, height, zero)), in);
    const F extinction = select(in, weight * places.readOne(table.extinction), zero);
    const M counts = in & (extinction > zero);
    if (!any(counts)) return;
    places.leave(counts);
    const PlaceColor* own = tintOf(counts);
    places.read([&](const auto& read) {
        addProperties<kColors, kIndirect>(table, extinction, weight, counts, read, own, sum);
    });
}

// Samples any medium: with noise, layers or gradients. Returns the displaced place. Properties that are not
// asked for are 0.
template <bool kColors, bool kIndirect>
[[gnu::noinline]] V3 sampleAny(const SweepScene& scene, const V3& place, F footprint, M m, Properties& p) {
    const F zero(0.0f), one(1.0f);
    p = {zero, {zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}, zero};
    Disturbance d;
    V3 there = place;
    if (scene.noise.texels) {
        d = disturbanceAt(scene.noise, place, m);
        there = {place.x + d.way.x, place.y + d.way.y, place.z + d.way.z};
    }
    if (scene.grid.values) {
        const V3 voxel = voxelOf(scene.grid, there);
        const M in = m & insideGrid(scene.grid, voxel);
        const SweepTable& table = scene.grid.table;
        Column at = columnOf(table, gridValue(scene.grid, voxel, in));
        if (table.rows > 1) setRow(table, lengthOf(gridGradient(scene.grid, voxel, in)), at);
        p.extinction = memberAt(table, table.extinction, at, in);
        const M seen = in & (p.extinction > zero);
        if (any(seen)) {
            if constexpr (kColors) readColors(table, at, seen, p);
            if constexpr (kIndirect) readIndirect(table, at, seen, p);
        }
    }
    for (int n = 0; n < scene.layerCount; ++n)
        if (kColors && scene.layers[n].color.texels)
            addLayer<kColors, kIndirect, kColors>(scene.layers[n], there, footprint, m, p);
        else
            addLayer<kColors, kIndirect, false>(scene.layers[n], there, footprint, m, p);
    if (scene.noise.texels) {
        p.extinction = p.extinction * max(d.extinction, zero);
        for (int k = 0; k < 3; ++k) {
            p.color[k] = clamp(p.color[k] * d.color[k], zero, one);
            p.indirect[k] = p.indirect[k] * max(d.indirect[k], zero);
        }
    }
    return there;
}

// Returns the upward normal of the layer nearest to a place; 0 where there is none.
[[gnu::noinline]] inline V3 layerNormal(const SweepScene& scene, const V3& place, M m) {
    const F zero(0.0f);
    V3 normal{zero, zero, zero};
    F least(__builtin_inff());
    for (int n = 0; n < scene.layerCount; ++n) {
        const SweepLayer& layer = scene.layers[n];
        const F d(1.0f / layer.perMetre);
        const auto height = [&](F dx, F dy) {
            return heightAt(layer, {place.x + dx, place.y + dy, place.z}, zero, m);
        };
        const F away = abs(place.z - F(layer.base) - height(zero, zero));
        const M nearer = m & (away < least);
        const F scale(-0.5f * layer.perMetre);
        const F x = (height(d, zero) - height(zero - d, zero)) * scale,
                y = (height(zero, d) - height(zero, zero - d)) * scale;
        const F tilt = select(abs(x) < F(1e30f), x, zero), lean = select(abs(y) < F(1e30f), y, zero);
        least = select(nearer, away, least);
        normal = {select(nearer, tilt, normal.x), select(nearer, lean, normal.y),
                  select(nearer, F(1.0f), normal.z)};
    }
    return normal;
}
// Turns a gradient along the grid's axes into one along the world's axes.
STEREONAV_INLINE V3 worldGradient(const SweepGrid& grid, const V3& g) {
    const auto row = [&](int k) {
        const float(&a)[3] = grid.axes[k];
        return mulAdd(g.x, F(a[0]), mulAdd(g.y, F(a[1]), g.z * F(a[2])));
    };
    return {row(0), row(1), row(2)};
}
// Returns a vector along the gradient, in world axes, of any length. place: after displacement.
[[gnu::noinline]] inline V3 gradientAt(const SweepScene& scene, const V3& place, M m) {
    if (!scene.grid.values) return layerNormal(scene, place, m);
    const V3 voxel = voxelOf(scene.grid, place);
    const M in = m & insideGrid(scene.grid, voxel);
    const F zero(0.0f);
    const V3 g = worldGradient(scene.grid, gridGradient(scene.grid, voxel, in));
    return {select(in, g.x, zero), select(in, g.y, zero), select(in, g.z, zero)};
}
// Exponential decay through a slab of optical depth z >= 0: its mean (1 - exp(-z)) / z, and what passes,
// exp(-z). A series serves small z: there the difference would lose digits, and the series costs less. The
// first term that it leaves out is below 2e-7 at the limit.
struct Decay {
    F mean, passes;
};
// Return (1 - exp(-s)) / s and exp(-s), for s up to 0.5.
STEREONAV_INLINE F thinMean(F s) {
    F mean = mulAdd(s, F(1.0f / 5040), F(-1.0f / 720));
    mean = mulAdd(mean, s, F(1.0f / 120));
    mean = mulAdd(mean, s, F(-1.0f / 24));
    mean = mulAdd(mean, s, F(1.0f / 6));
    mean = mulAdd(mean, s, F(-0.5f));
    return mulAdd(mean, s, F(1.0f));
}
STEREONAV_INLINE F thinlyPassed(F s) {
    return F(1.0f) - s * thinMean(s);
}
STEREONAV_INLINE Decay decayOf(F z) {
    const F limit(0.5f), one(1.0f);
    const F s = min(z, limit);
    F mean = thinMean(s), passes = one - s * mean;
    const M thick = z > limit;
    if (any(thick)) {
        const F left = exp2(z * F(-1.44269504f));
        passes = select(thick, left, passes);
        mean = select(thick, (one - left) * approxReciprocal(min(max(z, limit), F(1e30f))), mean);
    }
    return {mean, passes};
}
// Returns the slab's share by V5 (forward) or V6 (backward) of docs/volume_light.md; x, y: optical depths
// along the eye's and the light's ray.
STEREONAV_INLINE F slabShareOf(F x, F y, bool forward) {
    if (forward) return x * decayOf(x + y).mean;
    return x * decayOf(min(x, y)).passes * decayOf(abs(x - y)).mean;
}

// Returns the angle in radians, by formula 4.4.46 of Abramowitz and Stegun; its error is below 2e-8 plus
// rounding.
STEREONAV_INLINE F arcCosine(F cosine) {
    const F a = min(abs(cosine), F(1.0f));
    F p = mulAdd(a, F(-0.0012624911f), F(0.0066700901f));
    p = mulAdd(p, a, F(-0.0170881256f));
    p = mulAdd(p, a, F(0.0308918810f));
    p = mulAdd(p, a, F(-0.0501743046f));
    p = mulAdd(p, a, F(0.0889789874f));
    p = mulAdd(p, a, F(-0.2145988016f));
    p = mulAdd(p, a, F(1.5707963050f));
    const F angle = p * sqrt(F(1.0f) - a);
    return select(cosine < F(0.0f), F(3.14159265f) - angle, angle);
}
struct Colors {
    F c[3];
};
// Returns the phase function's weight for each colour channel.
STEREONAV_INLINE Colors phaseAt(const SweepLook& look, F cosine, M m) {
    if (!look.phase[0]) return {{F(1.0f), F(1.0f), F(1.0f)}};
    const F at = clamp(arcCosine(cosine) * F(1024.0f / 3.14159265f), F(0.0f), F(1024.0f));
    const I entry = min(truncateToInt(at), I(1023));
    const F share = at - toFloat(entry);
    return {{entryOf(look.phase[0], entry, share, m), entryOf(look.phase[1], entry, share, m),
             entryOf(look.phase[2], entry, share, m)}};
}

}  // namespace stereonav::STEREONAV_ISA
