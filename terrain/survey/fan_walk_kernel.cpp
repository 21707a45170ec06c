// Lines of sight from samples of a column back to the eye, a packet of them at once, in floats: what `slack`
// leaves open is not told. Compiled once for each instruction set.
#include "engine/simd/simd.h"
#include "terrain/survey/fan_rows.h"

namespace stereonav::STEREONAV_ISA {
namespace {

// Lines that differ in their rows alone.
struct Lines {
    F excess;  // excess of the tangent over the part's first one
    F tangent, rise, bulge;
    F reach;  // distance of the samples
    F slack, target;
    STEREONAV_INLINE F heightAt(F x) const { return x * (rise - bulge * (reach - x)); }
};

struct Verdict {
    M hidden, unsure;
};

struct Corners {
    F low, middle, high;  // corners of three rows
};

STEREONAV_INLINE Corners cornersAt(const float* heights, I row, M lanes) {
    return {gather(heights, row, lanes, F(0.0f)), gather(heights + 1, row, lanes, F(0.0f)),
            gather(heights + 2, row, lanes, F(0.0f))};
}
STEREONAV_INLINE F heightIn(const Corners& c, F at) {
    return select(at <= F(1.0f), mulAdd(at, c.middle - c.low, c.low),
                  mulAdd(at - F(1.0f), c.high - c.middle, c.middle));
}
// Returns how much the top of a bent piece may lie over its ends.
STEREONAV_INLINE F bulgeOver(F bend, F share) {
    return max(F(0.0f), bend * share * share * F(-0.25f));
}

constexpr float kBeside = 0x1p-10f;  // rows: nearer to a sample's row, the cells on both sides count

// Returns whether a line runs so near to a row that it may be another cell's, in which something is not
// known. f0, f1: its ends over `row`.
STEREONAV_INLINE M besideHole(const float* near, const float* far, I row, F f0, F f1, M lanes) {
    const F low = min(f0, f1), high = max(f0, f1);
    const M under = lanes & (low < F(kBeside));
    const I below = max(I(0), row - I(1));
    const F sum = gather(near, below, under, F(0.0f)) + gather(far, below, under, F(0.0f));
    return (under & ~(sum <= sum)) | (lanes & (high > F(2.0f - kBeside)));
}

// Tests the piece of a line from column k to the one before it, or to the eye, which lies in column 0's
// cells.
template <bool kToEye>
STEREONAV_INLINE Verdict piece(const WalkRows& rows, const Lines& lines, int k, M lanes) {
    const WalkColumn& far = rows.columns[k];
    const WalkColumn& near = rows.columns[k - 1];
    const F y1 = mulAdd(lines.excess, F(far.x), F(far.row)),
            y0 = mulAdd(lines.excess, F(near.x), F(far.rowBefore));
    const I row = max(I(0), min(floorToInt(min(y0, y1)), I(far.top)));
    const Corners c1 = cornersAt(rows.heights + far.offset, row, lanes),
                  c0 = cornersAt(rows.heights + near.offset + far.shift, row, lanes);
    const F low = toFloat(row), f0 = y0 - low, f1 = y1 - low, one(1.0f);
    // Share of the column step.
    const F length = kToEye ? F(far.x) : one, start = one - length;
    F ground0 = heightIn(c0, f0);
    if (kToEye) ground0 = mulAdd(start, heightIn(c1, f0) - ground0, ground0);
    const F over0 = ground0 - lines.heightAt(F(near.x)), over1 = heightIn(c1, f1) - lines.heightAt(F(far.x));
    F most = max(over0, over1);
    const F lower = mulAdd(c0.low - c1.low - c0.middle + c1.middle, lines.tangent, F(0.0f) - lines.bulge);
    const M crosses = lanes & (max(f0, f1) > one);
    F top;
    if (any(crosses)) {
        // Where it crosses the middle row.
        const F share = select(crosses, clamp((one - f0) / (f1 - f0), F(0.0f), one), one);
        const F x = mulAdd(share, length, F(near.x)), across = mulAdd(share, length, start);
        const F between = mulAdd(across, c1.middle - c0.middle, c0.middle) - lines.heightAt(x);
        most = select(crosses, max(most, between), most);
        const F upper =
            mulAdd(c0.middle - c1.middle - c0.high + c1.high, lines.tangent, F(0.0f) - lines.bulge);
        // The lower row's share is the one next to the lower end.
        const M rises = f0 < f1;
        const F shareLow = select(crosses, select(rises, share, one - share), one);
        top = most + max(bulgeOver(lower, shareLow * length), bulgeOver(upper, (one - shareLow) * length));
    } else {
        top = most + bulgeOver(lower, length);
    }
    // Unknown heights make the sum NaN.
    const F sum = (c0.low + c0.middle + c0.high) + (c1.low + c1.middle + c1.high);
    const M clear = (top < F(0.0f) - lines.slack) & (sum <= sum);
    const M hidden = lanes & (most > lines.slack) & (sum <= sum);
    if (rows.holes) {
        const M open =
            besideHole(rows.heights + near.offset + far.shift, rows.heights + far.offset, row, f0, f1, lanes);
        return {andNot(hidden, open), andNot(lanes, clear | hidden) | open};
    }
    return {hidden, andNot(lanes, clear | hidden)};
}

// Up to the sample itself, which the line meets: at a share s from there the ground lies
// s * (first + bend * s) over the line, less the target's height.
STEREONAV_INLINE Verdict lastPiece(const WalkRows& rows, const Lines& lines, I sample, M lanes) {
    const WalkColumn& far = rows.columns[rows.at];
    const WalkColumn& near = rows.columns[rows.at - 1];
    const M rises = F(0.0f) <= lines.tangent;
    const I row = max(I(0), min(select(rises, sample - I(1), sample), I(far.top)));
    const float *const heights0 = rows.heights + near.offset + far.shift, *const heights1 =
                                                                              rows.heights + far.offset;
    const FPair c0 = gatherPair(heights0, row, lanes), c1 = gatherPair(heights1, row, lanes);
    const F f0 = toFloat(sample - row) - lines.tangent;
    const F over = mulAdd(f0, c0.second - c0.first, c0.first) - lines.heightAt(F(near.x));
    const F bend = mulAdd(c0.first - c1.first - c0.second + c1.second, lines.tangent, F(0.0f) - lines.bulge);
    const F first = over + lines.target - bend, room = lines.slack + lines.target;
    const F sum = (c0.first + c0.second) + (c1.first + c1.second);
    const F least = F(0.0f) - lines.slack;
    const M known = sum <= sum;
    const M clear = known & (((first < least) & (over + lines.target < least)) |
                             (max(over, F(0.0f) - lines.target) + bulgeOver(bend, F(1.0f)) < least));
    // The cell's top lies inside and over the line, by more than rounding makes of it.
    const F sure = first - lines.slack - lines.slack;
    const M tops = (bend < F(0.0f)) & (F(0.0f) < sure) &
                   (first + lines.slack + lines.slack < bend * F(-2.0f)) &
                   (F(-4.0f) * bend * (room + room) < sure * sure);
    const M hidden = lanes & known & ((over > lines.slack) | tops);
    if (rows.holes) {
        const F size = abs(lines.tangent);
        const M open = lanes & ((size < F(kBeside)) | (F(1.0f - kBeside) < size));
        return {andNot(hidden, open), andNot(lanes, clear | hidden) | open};
    }
    return {hidden, andNot(lanes, clear | hidden)};
}

// Walks the blocks that reach up to the line, the last one first, until none before does.
STEREONAV_INLINE Verdict overBlocks(const WalkRows& rows, const Lines& lines, F slope, M lanes) {
    const F share = lines.excess * F(rows.width);
    Verdict all{andNot(lanes, lanes), andNot(lanes, lanes)};
    int to = rows.at - rows.lag;
    for (int b = rows.blockCount - 1; b >= 0; --b) {
        const WalkBlock& block = rows.blocks[b];
        const I bin =
            max(I(0), min(floorToInt(share * F(static_cast<float>(block.bins))), I(block.bins - 1)));
        lanes = lanes & (gather(block.before, bin, lanes, F(0.0f)) >= slope);
        if (!any(lanes)) break;
        M look = lanes & (gather(block.own, bin, lanes, F(0.0f)) >= slope);
        const int from = rows.first + b * rows.blockLength;
        for (int k = to; k > from && any(look); --k) {
            const Verdict here = piece<false>(rows, lines, k, look);
            all.hidden = all.hidden | here.hidden, all.unsure = all.unsure | here.unsure;
            look = andNot(look, here.hidden);
        }
        lanes = andNot(lanes, all.hidden);
        to = from;
    }
    return all;
}

}  // namespace

void walkSamples(const WalkRows& rows) {
    const WalkColumn& column = rows.columns[rows.at];
    for (int p = 0; p < rows.count; p += kLanes) {
        const M lanes = firstLanes(rows.count - p);
        const I sample = loadI(rows.rows + p);
        Lines lines;
        lines.reach = F(column.x), lines.slack = F(rows.slack), lines.target = F(rows.targetHeight);
        lines.excess = (toFloat(sample) - F(column.row)) * F(rows.inverse);
        lines.tangent = F(rows.tangent) + lines.excess;
        const F height = gather(rows.heights + column.offset, sample, lanes, F(0.0f)) + lines.target;
        lines.rise = height * F(rows.inverse);
        lines.bulge = mulAdd(lines.tangent * lines.tangent, F(rows.bulgeAcross), F(rows.bulgeAlong));
        const F slope = (height - lines.slack) * F(rows.inverse) - lines.bulge * lines.reach;
        Verdict all = lastPiece(rows, lines, sample, lanes);
        M left = andNot(lanes, all.hidden);
        for (int k = rows.at - 1; k > rows.at - rows.lag && any(left); --k) {
            const Verdict here = piece<false>(rows, lines, k, left);
            all.hidden = all.hidden | here.hidden, all.unsure = all.unsure | here.unsure;
            left = andNot(left, here.hidden);
        }
        M beside = left & (slope <= F(rows.beside));
        for (int k = rows.first; k >= 0 && any(beside); --k) {
            const Verdict here =
                k == 0 ? piece<true>(rows, lines, k, beside) : piece<false>(rows, lines, k, beside);
            all.hidden = all.hidden | here.hidden, all.unsure = all.unsure | here.unsure;
            beside = andNot(beside, here.hidden);
        }
        left = andNot(left, all.hidden);
        std::uint32_t above = 0;
        for (int k = 0; k < kLanes && p + k < rows.count; ++k) above |= std::uint32_t(rows.above[p + k]) << k;
        left = andNot(left, maskFromBits(above));
        if (any(left)) {
            const Verdict far = overBlocks(rows, lines, slope, left);
            all.hidden = all.hidden | far.hidden, all.unsure = all.unsure | far.unsure;
        }
        const std::uint32_t hidden = bits(all.hidden), unsure = bits(all.unsure);
        for (int k = 0; k < kLanes && p + k < rows.count; ++k)
            rows.told[p + k] = hidden >> k & 1 ? kToldHidden : unsure >> k & 1 ? kUntold : kToldClear;
    }
}

}  // namespace stereonav::STEREONAV_ISA
