// Contour lines of a row of pixels: where there may be one, how much ink each pixel gets, and the ink.
// Compiled once for each instruction set.
#include <limits>

#include "engine/simd/simd.h"
#include "terrain/paint/contour_row.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr float kMost = std::numeric_limits<float>::max();

STEREONAV_INLINE I nearestInt(F a) {
    return floorToInt(a + F(0.5f));
}

STEREONAV_INLINE F distanceFrom(F height, float step) {
    return abs(height - F(step) * toFloat(nearestInt(height * F(1 / step))));
}

// Heights over the eye of pixels beside a row's, and which of them show something.
struct Heights {
    F value;
    M known;
};
STEREONAV_INLINE Heights heightsAt(const float* depth, F ray, M lanes) {
    const F t = loadF(depth);
    const M known = lanes & (t > F(0.0f)) & (t <= F(kMost));
    return {keep(known, t) * ray, known};
}

// By how much a pixel's height differs from those at both sides: the more of both (all there is where neither
// is known), and the less (0 where neither is).
struct HeightSteps {
    F more, less;
};
STEREONAV_INLINE HeightSteps stepsOf(F height, const Heights& before, const Heights& after) {
    const F a = abs(before.value - height), b = abs(after.value - height);
    const M any = before.known | after.known;
    return {select(any, max(keep(before.known, a), keep(after.known, b)), F(kMost)),
            keep(any, min(select(before.known, a, F(kMost)), select(after.known, b, F(kMost))))};
}

STEREONAV_INLINE F coverOfLine(float width, F distance) {
    return clamp(F(0.5f * width + 0.5f) - distance, F(0.0f), F(width < 1 ? width : 1.0f));
}

STEREONAV_INLINE F fadeOfLines(const ContourShape& shape, F pixelsBetween) {
    const F share =
        clamp((pixelsBetween - F(shape.gone)) * F(1 / (shape.whole - shape.gone)), F(0.0f), F(1.0f));
    return share * share * (F(3.0f) - F(2.0f) * share);
}

// A cell of the ground where a ray meets it: height of the first corner, and there over that; the gradient.
struct Cell {
    F corner, rise, gradientX, gradientY;
    M found;
};
STEREONAV_INLINE Cell cellAt(const ContourRow& row, F x, F y, M lanes) {
    const F gx = mulAdd(x, F(row.inverseSpacing[0]), F(row.place[0])),
            gy = mulAdd(y, F(row.inverseSpacing[1]), F(row.place[1]));
    const M inside = lanes & (gx >= F(row.low[0])) & (gx <= F(row.high[0])) & (gy >= F(row.low[1])) &
                     (gy <= F(row.high[1]));
    const I cellX(row.cell[0]), cellY(row.cell[1]);
    const I i = clamp(floorToInt(keep(inside, gx)) + cellX, I(0), I(row.groundWidth - 2)),
            j = clamp(floorToInt(keep(inside, gy)) + cellY, I(0), I(row.groundHeight - 2));
    const F u = gx - toFloat(i - cellX), v = gy - toFloat(j - cellY);
    const I index = j * I(row.groundWidth) + i;
    const FPair south = gatherPair(row.heights, index, inside),
                north = gatherPair(row.heights + row.groundWidth, index, inside);
    const F southRise = south.second - south.first, northRise = north.second - north.first;
    const F across = mulAdd(u, northRise - southRise, north.first - south.first);
    Cell cell;
    cell.rise = mulAdd(v, across, u * southRise);
    cell.found = inside & (abs(cell.rise) <= F(kMost));
    cell.corner = keep(cell.found, south.first);
    cell.gradientX = lerp(southRise, northRise, v) * F(row.inverseSpacing[0]);
    cell.gradientY = across * F(row.inverseSpacing[1]);
    return cell;
}

// The ground as GroundView::at() follows a pixel's ray to it.
struct Seen {
    F depth, corner, rise;  // height: of a cell's corner, and over that
    F change;               // change of the height from pixel to pixel, metres of the ground
    M found;
};

// Height over the nearest wide line below, or above.
STEREONAV_INLINE F heightOverLine(const ContourRow& row, const Seen& seen) {
    const I line = nearestInt(seen.corner * F(static_cast<float>(1 / row.indexStep)));
    return toFloat(toDouble(seen.corner) - toDouble(line) * D(row.indexStep)) + seen.rise;
}

STEREONAV_INLINE Seen groundAt(const ContourRow& row, F pixel, F depth, M lanes) {
    constexpr int kMostNewtonSteps = 3;
    const F rx = mulAdd(pixel, F(row.right[0]), F(row.ray[0])),
            ry = mulAdd(pixel, F(row.right[1]), F(row.ray[1])),
            rz = mulAdd(pixel, F(row.right[2]), F(row.ray[2]));
    const auto eyeHigh = static_cast<float>(row.eyeHeight);
    const auto eyeLow = static_cast<float>(row.eyeHeight - eyeHigh);
    Seen seen{depth, F(0.0f), F(0.0f), F(0.0f), lanes};
    M active = lanes;
    const F cellsAcross =
        sqrt(mulAdd(rx, rx, ry * ry)) *
        F(row.inverseSpacing[0] > row.inverseSpacing[1] ? row.inverseSpacing[0] : row.inverseSpacing[1]);
    for (int step = 0; step < kMostNewtonSteps && any(active); ++step) {
        const F t = seen.depth;
        const Cell cell = cellAt(row, t * rx, t * ry, active);
        const F gx = keep(cell.found, cell.gradientX), gy = keep(cell.found, cell.gradientY);
        const F into = rz - mulAdd(gx, rx, gy * ry);
        const M met = cell.found & ((into < F(0.0f)) | (into > F(0.0f)));
        const F inverse = F(1.0f) / select(met, into, F(1.0f));
        const F alongX = F(row.right[2]) - mulAdd(gx, F(row.right[0]), gy * F(row.right[1])),
                alongY = F(row.up[2]) - mulAdd(gx, F(row.up[0]), gy * F(row.up[1]));
        const F perX = F(0.0f) - t * alongX * inverse, perY = t * alongY * inverse;
        const F pixels = max(abs(perX), abs(perY));
        // The eye's height in two parts: what is near it loses nothing.
        const F height = ((cell.corner - F(eyeHigh)) - F(eyeLow)) + cell.rise;
        const F move = (keep(met, height) - t * rz) * inverse, moved = t + move;
        const M near =
            met & (moved > F(0.0f)) & (abs(moved - depth) <= mulAdd(F(2.0f), pixels, F(1e-3f) * depth));
        seen.found = seen.found & (near | ~active);
        if (step == 0) seen.found = seen.found & (abs(move) * cellsAcross <= F(row.sameCell));
        active = active & near;
        // Along the tangent plane, as the height is.
        const F acrossX = mulAdd(perX, rx, moved * F(row.right[0])),
                acrossY = mulAdd(perX, ry, moved * F(row.right[1]));
        const F downX = mulAdd(perY, rx, F(0.0f) - moved * F(row.up[0])),
                downY = mulAdd(perY, ry, F(0.0f) - moved * F(row.up[1]));
        const F i = mulAdd(gx, acrossX, gy * acrossY), j = mulAdd(gx, downX, gy * downY);
        seen.depth = select(active, moved, seen.depth);
        const F on = mulAdd(gx, move * rx, gy * (move * ry));
        seen.corner = select(active, cell.corner, seen.corner);
        seen.rise = select(active, cell.rise + on, seen.rise);
        seen.change = select(active, sqrt(mulAdd(i, i, j * j)), seen.change);
        active = active & (abs(move) > F(1e-3f) * pixels);
    }
    return seen;
}

STEREONAV_INLINE I inkedChannel(I channel, float ink, F share) {
    const F root = toFloat(channel) * F(1.0f / 1023);
    const F linear = root * root * (F(1.0f) - share) + F(ink) * share;
    return truncateToInt(mulAdd(sqrt(clamp(linear, F(0.0f), F(1.0f))), F(1023.0f), F(0.5f)));
}

}  // namespace

int findLinePixels(const ContourRow& row) {
    constexpr float kRounding = 0x1p-21f;
    const M none = firstLanes(0);
    int count = 0;
    for (int x = 0; x < row.width; x += kLanes) {
        const M lanes = firstLanes(row.width - x);
        const F at = laneIndexF() + F(static_cast<float>(x));
        const F ray = mulAdd(at, F(row.right[2]), F(row.ray[2]));
        const Heights here = heightsAt(row.depth + x, ray, lanes);
        if (!any(here.known)) continue;
        // The pixel before the row's first one lies in the row's own memory or before the plane: not read.
        Heights before{F(0.0f), none};
        if (x > 0) {
            before = heightsAt(row.depth + x - 1, ray - F(row.right[2]), lanes);
        } else {
            const M others = lanes & (at > F(0.0f));
            const F t = gather(row.depth, max(laneIndex() - I(1), I(0)), others, F(0.0f));
            before.known = others & (t > F(0.0f)) & (t <= F(kMost));
            before.value = keep(before.known, t) * (ray - F(row.right[2]));
        }
        const Heights after =
            heightsAt(row.depth + x + 1, ray + F(row.right[2]), firstLanes(row.width - 1 - x));
        Heights above{F(0.0f), none}, below{F(0.0f), none};
        if (row.above != nullptr) above = heightsAt(row.above + x, ray + F(row.up[2]), lanes);
        if (row.below != nullptr) below = heightsAt(row.below + x, ray - F(row.up[2]), lanes);
        const HeightSteps across = stepsOf(here.value, before, after),
                          down = stepsOf(here.value, above, below);
        const F least = F(0.5f * row.perMetre) * max(across.less, down.less);
        const F most = min(across.more, F(0.25f * kMost)) + min(down.more, F(0.25f * kMost));
        const F reach =
            F(row.perMetre) * mulAdd(F(row.shape.reach), min(most, F(1e30f)), F(kRounding) * abs(here.value));
        const F over = mulAdd(here.value, F(row.perMetre), F(row.eyeOver));
        const M may = here.known & (distanceFrom(over, row.interval) <= reach) &
                      (F(row.shape.gone) * least < F(row.shape.index * row.interval));
        store(row.least + x, least);
        for (std::uint32_t left = bits(may); left != 0; left &= left - 1)
            row.pixels[count++] = x + __builtin_ctz(left);
    }
    return count;
}

void shareOfLines(const ContourRow& row, int pixels) {
    const ContourShape& shape = row.shape;
    const float indexInterval = shape.index * row.interval;
    for (int k = 0; k < pixels; k += kLanes) {
        const M lanes = firstLanes(pixels - k);
        const I pixel = keep(lanes, loadI(row.pixels + k));
        const F depth = gather(row.depth, pixel, lanes, F(1.0f));
        const Seen seen = groundAt(row, toFloat(pixel), depth, lanes);
        const F over = F(row.perMetre) * heightOverLine(row, seen), change = F(row.perMetre) * seen.change;
        const M sloped = seen.found & (change > F(shape.level * row.interval));
        const F perChange = F(1.0f) / select(sloped, change, F(1.0f));
        const F wide = F(shape.indexShare) *
                       coverOfLine(shape.indexWidth, distanceFrom(over, indexInterval) * perChange),
                thin =
                    F(shape.share) * coverOfLine(shape.width, distanceFrom(over, row.interval) * perChange);
        const F rough = max(select(sloped, change, F(1.0f)), gather(row.least, pixel, lanes, F(0.0f)));
        const F between = F(row.interval) / rough;
        const F ink =
            max(wide * fadeOfLines(shape, F(shape.index) * between), thin * fadeOfLines(shape, between));
        store(row.share + k, keep(sloped, ink));
        store(row.seen + k, select(seen.found, seen.depth, F(-1.0f)));
    }
}

void inkLines(const ContourRow& row, int pixels) {
    for (int k = 0; k < pixels; k += kLanes) {
        const F share = loadF(row.share + k);
        const M inked = firstLanes(pixels - k) & (share > F(0.0f));
        if (!any(inked)) continue;
        const I pixel = loadI(row.pixels + k);
        const I color = gather(row.color, pixel, inked), channel(1023);
        const F ink = keep(inked, share);
        const I red = inkedChannel(color & channel, row.shape.ink[0], ink);
        const I green = inkedChannel(shiftRight<10>(color) & channel, row.shape.ink[1], ink);
        const I blue = inkedChannel(shiftRight<20>(color) & channel, row.shape.ink[2], ink);
        scatter(reinterpret_cast<std::int32_t*>(row.color), pixel,
                red | shiftLeft<10>(green) | shiftLeft<20>(blue), inked);
    }
}

}  // namespace stereonav::STEREONAV_ISA
