// Sums, minima and maxima of boxes and the openness made of them, for one instruction set. Along j and k
// whole rows are combined: running sums, and minima and maxima by van Herk 1992 / Gil and Werman 1993 (three
// comparisons a voxel whatever the radius). Along i sums are differences of a running sum and extrema are
// found by doubling the window (log2 of it steps on whole vectors: less work than one by one at any radius).
// No contraction and no approximate instruction: all instruction sets give the same bytes.
#include "engine/light/occlusion/occlusion_kernel_types.h"
#include "engine/simd/simd.h"

#if STEREONAV_ISA_avx512
// g++ 12 warns about its own undefined registers (gcc bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

namespace stereonav::STEREONAV_ISA {
namespace {

using Int16 = std::int16_t;
constexpr Int16 kNoLow = 32767, kNoHigh = -32768;

STEREONAV_INLINE int least(int a, int b) {
    return a < b ? a : b;
}
STEREONAV_INLINE int most(int a, int b) {
    return a < b ? b : a;
}

// ---- minima and maxima of rows

struct Extrema {
    Int16 *low, *high;
};

// Loops over `n` columns; kFixed != 0 promises that n is that.
template <int kFixed>
STEREONAV_INLINE int columns(int n) {
    return kFixed ? kFixed : n;
}

template <int kFixed>
STEREONAV_INLINE void setNone(Extrema to, int n) {
    for (int i = 0; i < columns<kFixed>(n); ++i) to.low[i] = kNoLow;
    for (int i = 0; i < columns<kFixed>(n); ++i) to.high[i] = kNoHigh;
}

// to = a with b; `to` may be a.
template <int kFixed>
STEREONAV_INLINE void combine(Extrema a, const Int16* bLow, const Int16* bHigh, Extrema to, int n) {
    const Int16 *aLow = a.low, *aHigh = a.high;
    Int16 *low = to.low, *high = to.high;
    if constexpr (kFixed > 0) {
        // Through memory of its own, which the compiler keeps in registers and knows to be apart.
        constexpr int kPart = 32;
        for (int at = 0; at < kFixed; at += kPart) {
            Int16 lowPart[kPart], highPart[kPart];
            for (int i = 0; i < kPart; ++i)
                lowPart[i] = aLow[at + i] < bLow[at + i] ? aLow[at + i] : bLow[at + i];
            for (int i = 0; i < kPart; ++i)
                highPart[i] = aHigh[at + i] > bHigh[at + i] ? aHigh[at + i] : bHigh[at + i];
            for (int i = 0; i < kPart; ++i) low[at + i] = lowPart[i];
            for (int i = 0; i < kPart; ++i) high[at + i] = highPart[i];
        }
    } else {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) low[i] = aLow[i] < bLow[i] ? aLow[i] : bLow[i];
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) high[i] = aHigh[i] > bHigh[i] ? aHigh[i] : bHigh[i];
    }
}

// Columns of an image: low and high of row j at low + j * pitch; both are the same for plain values.
struct Rows {
    const Int16 *low, *high;
    std::ptrdiff_t pitch;
    int count;  // rows outside [0, count) hold nothing
};

// Extrema of rows j - radius .. j + radius for j = first .. end - 1, one after another. Blocks of a window's
// length start at the first row's window; a window is the suffix of one block and the prefix of the next.
template <int kFixed>
class SlidingExtrema {
public:
    SlidingExtrema(const Rows& rows, int radius, int first, int end, int n, const OcclusionScratch& scratch)
        : mRows(rows),
          mWindow(2 * radius + 1),
          mStart(first - radius),
          mLeft(end - first),
          mN(n),
          mRun{scratch.runLows, scratch.runHighs},
          mSuffixes{scratch.suffixLows, scratch.suffixHighs} {}

    // The next row's.
    STEREONAV_INLINE void next(Extrema to) {
        if (mAt == 0) startBlock();
        if (mAt > 0) widenBy(mStart + mWindow + mAt - 1);
        combine<kFixed>(suffixAt(mAt), mRun.low, mRun.high, to, mN);
        --mLeft;
        if (++mAt < mWindow) return;
        mAt = 0;
        mStart += mWindow;
    }

private:
    STEREONAV_INLINE Extrema suffixAt(int at) const {
        const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(at) * kOcclusionStrip;
        return {mSuffixes.low + offset, mSuffixes.high + offset};
    }
    STEREONAV_INLINE bool holds(int row) const { return row >= 0 && row < mRows.count; }
    STEREONAV_INLINE void widenBy(int row) {
        const std::ptrdiff_t offset = row * mRows.pitch;
        if (holds(row)) combine<kFixed>(mRun, mRows.low + offset, mRows.high + offset, mRun, mN);
    }

    // Suffixes that no row is left for are not kept.
    void startBlock() {
        const int kept = least(mWindow, mLeft);
        setNone<kFixed>(mRun, mN);
        for (int at = mWindow - 1; at >= kept; --at) widenBy(mStart + at);
        for (int at = kept - 1; at >= 0; --at) {
            const Extrema behind = at + 1 < kept ? suffixAt(at + 1) : mRun;
            const int row = mStart + at;
            const std::ptrdiff_t offset = row * mRows.pitch;
            if (holds(row))
                combine<kFixed>(behind, mRows.low + offset, mRows.high + offset, suffixAt(at), mN);
            else
                combine<kFixed>(behind, behind.low, behind.high, suffixAt(at), mN);
        }
        setNone<kFixed>(mRun, mN);
    }

    Rows mRows;
    int mWindow, mStart, mLeft, mN, mAt = 0;
    Extrema mRun, mSuffixes;
};

// a[i] = least of a[i] .. a[i + window - 1], for i < n; a has n + window - 1 numbers.
void leastOfWindows(Int16* a, Int16* __restrict to, int n, int window) {
    int span = 1;
    for (; 2 * span <= window; span *= 2) {
        const int count = n + window - 2 * span;
        const Int16* b = a + span;
#pragma GCC ivdep
        for (int i = 0; i < count; ++i) a[i] = a[i] < b[i] ? a[i] : b[i];
    }
    const Int16* b = a + (window - span);
    for (int i = 0; i < n; ++i) to[i] = a[i] < b[i] ? a[i] : b[i];
}

void mostOfWindows(Int16* a, Int16* __restrict to, int n, int window) {
    int span = 1;
    for (; 2 * span <= window; span *= 2) {
        const int count = n + window - 2 * span;
        const Int16* b = a + span;
#pragma GCC ivdep
        for (int i = 0; i < count; ++i) a[i] = a[i] > b[i] ? a[i] : b[i];
    }
    const Int16* b = a + (window - span);
    for (int i = 0; i < n; ++i) to[i] = a[i] > b[i] ? a[i] : b[i];
}

// ---- sums of rows

void addRow(std::int32_t* __restrict sums, const Int16* __restrict row, int n) {
    for (int i = 0; i < n; ++i) sums[i] += row[i];
}

void exchangeRow(std::int32_t* __restrict sums, const Int16* __restrict in, const Int16* __restrict out,
                 int n) {
    for (int i = 0; i < n; ++i) sums[i] += in[i] - out[i];
}

void dropRow(std::int32_t* __restrict sums, const Int16* __restrict row, int n) {
    for (int i = 0; i < n; ++i) sums[i] -= row[i];
}

void addSquares(std::int64_t* __restrict sums, const Int16* __restrict row, int n) {
    for (int i = 0; i < n; ++i) sums[i] += static_cast<std::int32_t>(row[i]) * row[i];
}

void dropSquares(std::int64_t* __restrict sums, const Int16* __restrict row, int n) {
    for (int i = 0; i < n; ++i) sums[i] -= static_cast<std::int32_t>(row[i]) * row[i];
}

// Sums over windows of 2 radius + 1 along a row, clipped to it. Sums wrap around; their differences, which
// fit, do not mind.
template <typename Sum, typename Prefix>
STEREONAV_INLINE void fillPrefix(const Sum* sums, Prefix* prefix, int n, int radius) {
    for (int i = 0; i <= radius; ++i) prefix[i] = 0;
    Prefix sum = 0;
    Prefix* at = prefix + radius + 1;
    for (int i = 0; i < n; ++i) at[i] = sum += static_cast<Prefix>(sums[i]);
    for (int i = n; i < n + radius; ++i) at[i] = sum;
}

void windowSums(const std::int32_t* sums, std::uint32_t* prefix, std::int32_t* __restrict to, int n,
                int radius) {
    fillPrefix(sums, prefix, n, radius);
    const std::uint32_t *ahead = prefix + 2 * radius + 1, *behind = prefix;
    for (int i = 0; i < n; ++i) to[i] = static_cast<std::int32_t>(ahead[i] - behind[i]);
}

// Writes whole numbers as doubles, by setting the mantissa: exact for whole numbers below 2^52, and vectors
// can do it everywhere.
void windowSquares(const std::int64_t* sums, std::uint64_t* prefix, double* __restrict to, int n,
                   int radius) {
    fillPrefix(sums, prefix, n, radius);
    const std::uint64_t *ahead = prefix + 2 * radius + 1, *behind = prefix;
    for (int i = 0; i < n; ++i)
        to[i] =
            __builtin_bit_cast(double, (ahead[i] - behind[i]) | 0x4330000000000000ull) - 4503599627370496.0;
}

// ---- along k

// total += in - out; either may be null.
void exchange(double* total, const std::int32_t* in, const std::int32_t* out, int n) {
    for (int i = 0; i < n; i += kLanes) {
        D d = loadD(total + i);
        if (in) d = d + toDouble(loadI(in + i));
        if (out) d = d - toDouble(loadI(out + i));
        store(total + i, d);
    }
}

void exchange(double* total, const double* in, const double* out, int n) {
    for (int i = 0; i < n; i += kLanes) {
        D d = loadD(total + i);
        if (in) d = d + loadD(in + i);
        if (out) d = d - loadD(out + i);
        store(total + i, d);
    }
}

// ---- from a box's numbers to the result

// log2 of t > 0 by 2 atanh((m - 1) / (m + 1)), m in [0.7, 1.42): four terms of the series, off by 1e-7 of it.
STEREONAV_INLINE F log2Of(F t) {
    constexpr float kScale = 2.885390081777927f;  // 2 / ln 2
    const I raw = asInt(t) - I(0x3f3504f3);       // relative to the bits of sqrt(1/2)
    const I exponent = shiftRight<23>(raw);
    const F m = asFloat((raw & I(0x007fffff)) + I(0x3f3504f3));
    const F s = (m - F(1.0f)) / (m + F(1.0f));
    const F q = s * s;
    const F series = F(1.0f) + q * (F(1 / 3.0f) + q * (F(1 / 5.0f) + q * F(1 / 7.0f)));
    return toFloat(exponent) + F(kScale) * (s * series);
}

// 2^x for x <= 0 by the series of e^(f ln 2), |f| <= 1/2; 0 below -126.
STEREONAV_INLINE F exp2Of(F x) {
    constexpr float kLn2 = 0.693147180559945f;
    const F limited = max(x, F(-126.0f));
    const I whole = floorToInt(limited + F(0.5f));
    const F f = (limited - toFloat(whole)) * F(kLn2);
    const F tail = F(1 / 24.0f) + f * (F(1 / 120.0f) + f * F(1 / 720.0f));
    const F series = F(1.0f) + f * (F(1.0f) + f * (F(0.5f) + f * (F(1 / 6.0f) + f * tail)));
    return series * asFloat(shiftLeft<23>(whole + I(127)));
}

STEREONAV_INLINE I inBytes(F share) {
    return truncateToInt(clamp(share, F(0.0f), F(1.0f)) * F(255.0f) + F(0.5f));
}

// Section 3.2. The differences are whole numbers, so nothing cancels; both are 0 only when all is equal.
STEREONAV_INLINE F reconstructed(bool turned, float beta, I value, I low, I high, D sum, D count) {
    const D lowest = count * toDouble(low), highest = count * toDouble(high);
    const F below = toFloat(turned ? highest - sum : sum - lowest);
    const F above = toFloat(turned ? sum - lowest : highest - sum);
    const I range = high - low, place = turned ? high - value : value - low;
    const F t = toFloat(place) / toFloat(range);
    const F exponent = beta > 0 ? F(beta) : below / above;
    const F open = exp2Of(exponent * log2Of(t));
    const F ends = select(place == I(0), F(0.0f), open);
    return select(range == I(0), F(0.5f), ends);
}

struct Moments {
    F away, variance;  // the value less the mean, upwards in density, and the variance; stored numbers
    M even;            // all values equal
};

// Variance from squares about a whole number m near the mean: squares - 2 m sum + count m^2 and sum - count m
// are whole numbers below 2^53, exact. Whole numbers are at most their squares, so what is subtracted last is
// at most half of what it is subtracted from.
STEREONAV_INLINE Moments moments(bool turned, I value, D sum, D squares, D count) {
    const F inverse = F(1.0f) / toFloat(count);
    const D m = toDouble(floorToInt(toFloat(sum) * inverse + F(0.5f)));
    const D countM = count * m;
    const F about = toFloat(squares - m * (sum + sum) + countM * m);
    const F shift = toFloat(sum - countM) * inverse;
    const D higher = count * toDouble(value) - sum;
    const F away = toFloat(turned ? D(0.0) - higher : higher) * inverse;
    return {away, max(about * inverse - shift * shift, F(0.0f)), about <= F(0.0f)};
}

// The same as `reconstructed` between ends at most `deviations` standard deviations from the mean, and bit
// for bit that where neither end is drawn in. Lengths are times `count` where the sums are. From an end that
// is the box's own t counts in whole numbers; from one drawn in, where away + reach cancels, beta is at least
// 1 and t near 0 says nothing.
STEREONAV_INLINE F drawnIn(const Moments& box, bool turned, float deviations, I value, I low, I high, D sum,
                           D count) {
    const D lowest = count * toDouble(low), highest = count * toDouble(high);
    const F below = toFloat(turned ? highest - sum : sum - lowest);
    const F above = toFloat(turned ? sum - lowest : highest - sum);
    const F number = toFloat(count), sigmas = F(deviations) * sqrt(box.variance), reach = sigmas * number;
    const F lower = min(below, reach), upper = min(above, reach);
    const F whole = toFloat(high - low), part = (lower + upper) / number;
    const F range = select(max(below, above) <= reach, whole, part);
    const I place = turned ? high - value : value - low;
    const F from = select(below <= reach, toFloat(place), box.away + sigmas);
    const F t = clamp(from / range, F(1e-37f), F(1.0f));
    const F open = exp2Of(lower / upper * log2Of(t));
    const F ends = select(place == I(0), F(0.0f), open);
    return select(box.even, F(0.5f), ends);
}

STEREONAV_INLINE F gaussian(const Moments& box) {
    constexpr float kA = 0.140012288686666f, kFourByPi = 1.27323954473516f, kLog2E = 1.44269504088896f;
    const F square = min(box.away * box.away / (box.variance + box.variance), F(1e6f));
    const F exponent = square * (F(kFourByPi) + F(kA) * square) / (F(1.0f) + F(kA) * square);
    const F half = F(0.5f) * sqrt(max(F(1.0f) - exp2Of(exponent * F(-kLog2E)), F(0.0f)));
    const F open = select(box.away < F(0.0f), F(0.5f) - half, F(0.5f) + half);
    return select(box.even, F(0.5f), open);
}

STEREONAV_INLINE F chebyshev(const Moments& box) {
    const F square = box.away * box.away;
    const F open = select(box.away > F(0.0f), square / (box.variance + square), F(0.0f));
    return select(box.even, F(0.5f), open);
}

STEREONAV_INLINE F resultOf(const OcclusionBand& band, const OcclusionScratch& s, int i, D count) {
    const D sum = loadD(s.total + i);
    const I value = loadI(s.value + i);
    if (!band.moments())
        return reconstructed(band.turned, band.beta, value, loadI(s.low + i), loadI(s.high + i), sum, count);
    const Moments box = moments(band.turned, value, sum, loadD(s.totalSquares + i), count);
    if (band.extrema())
        return drawnIn(box, band.turned, band.deviations, value, loadI(s.low + i), loadI(s.high + i), sum,
                       count);
    if (band.result == BoxResult::Gaussian) return gaussian(box);
    if (band.result == BoxResult::Chebyshev) return chebyshev(box);
    return box.variance * F(band.perVariance);
}

void toInt32(const Int16* __restrict from, std::int32_t* __restrict to, int n) {
    for (int i = 0; i < n; ++i) to[i] = from[i];
}

void toBytes(const std::int32_t* __restrict from, std::uint8_t* __restrict to, int n) {
    for (int i = 0; i < n; ++i) to[i] = static_cast<std::uint8_t>(from[i]);
}

// A strip's results of row (j, k), from column i on; s holds its boxes.
void finishStrip(const OcclusionBand& band, const OcclusionScratch& s, int i, int j, int k, double rows) {
    const std::ptrdiff_t at = (static_cast<std::ptrdiff_t>(k) * band.size[1] + j) * band.size[0] + i;
    const int n = least(band.size[0] - i, kOcclusionStrip);
    toInt32(band.values + at, s.value, n);
    if (band.extrema()) {
        toInt32(s.lows, s.low, kOcclusionStrip);
        toInt32(s.highs, s.high, kOcclusionStrip);
    }
    for (int c = 0; c < kOcclusionStrip; c += kLanes)
        store(s.out + c, inBytes(resultOf(band, s, c, loadD(band.columnCounts + i + c) * D(rows))));
    toBytes(s.out, band.to + at, n);
}

STEREONAV_INLINE int clippedWindow(int at, int radius, int size) {
    return least(at + radius, size - 1) - most(at - radius, 0) + 1;
}

// ---- the band's steps

// Extrema along j of a slice's strip of n columns from i on, into the band's boxes.
template <int kFixed>
void extremaAlongJ(const OcclusionBand& band, int i, int k, int n, const OcclusionScratch& s) {
    const Int16* from = band.values + static_cast<std::ptrdiff_t>(k) * band.size[1] * band.size[0] + i;
    SlidingExtrema<kFixed> sliding({from, from, band.size[0], band.size[1]}, band.radius[1], band.first,
                                   band.end, n, s);
    for (int j = band.first; j < band.end; ++j) {
        const std::ptrdiff_t to = band.boxRow(j, k) + i;
        sliding.next({band.lows + to, band.highs + to});
    }
}

// Extrema along i of a row of boxes, in place.
void extremaAlongI(const OcclusionBand& band, Int16* lows, Int16* highs, const OcclusionScratch& s) {
    const int n = band.size[0], reach = band.radius[0];
    setNone<0>({s.lows, s.highs}, reach);
    setNone<0>({s.lows + reach + n, s.highs + reach + n}, reach);
    __builtin_memcpy(s.lows + reach, lows, static_cast<std::size_t>(n) * sizeof(Int16));
    __builtin_memcpy(s.highs + reach, highs, static_cast<std::size_t>(n) * sizeof(Int16));
    leastOfWindows(s.lows, lows, n, 2 * reach + 1);
    mostOfWindows(s.highs, highs, n, 2 * reach + 1);
}

void filterExtrema(const OcclusionBand& band, int k, const OcclusionScratch& s) {
    const int n = band.size[0];
    int i = 0;
    for (; i + kOcclusionStrip <= n; i += kOcclusionStrip)
        extremaAlongJ<kOcclusionStrip>(band, i, k, kOcclusionStrip, s);
    if (i < n) extremaAlongJ<0>(band, i, k, n - i, s);
    for (int j = band.first; j < band.end; ++j) {
        const std::ptrdiff_t at = band.boxRow(j, k);
        extremaAlongI(band, band.lows + at, band.highs + at, s);
    }
}

// A slice's rows, and where its sums along j are kept.
struct Slice {
    const Int16* values;
    int width, height, radius;
    STEREONAV_INLINE const Int16* row(int j) const { return values + static_cast<std::ptrdiff_t>(j) * width; }
    STEREONAV_INLINE bool enters(int j) const { return j + radius < height; }
    STEREONAV_INLINE bool leaves(int j) const { return j > radius; }
    STEREONAV_INLINE const Int16* entering(int j) const { return row(j + radius); }
    STEREONAV_INLINE const Int16* leaving(int j) const { return row(j - radius - 1); }
};

void filterSums(const OcclusionBand& band, const Slice& slice, int k, const OcclusionScratch& s) {
    const int n = slice.width;
    std::int32_t* sums = band.lastSums + static_cast<std::ptrdiff_t>(k) * band.stride;
    if (band.first == 0)
        for (int j = 0; j < slice.radius; ++j) addRow(sums, slice.row(j), n);
    for (int j = band.first; j < band.end; ++j) {
        const bool enters = slice.enters(j), leaves = slice.leaves(j);
        if (enters && leaves)
            exchangeRow(sums, slice.entering(j), slice.leaving(j), n);
        else if (enters)
            addRow(sums, slice.entering(j), n);
        else if (leaves)
            dropRow(sums, slice.leaving(j), n);
        windowSums(sums, s.prefix, band.sums + band.boxRow(j, k), n, band.radius[0]);
    }
}

void filterSquares(const OcclusionBand& band, const Slice& slice, int k, const OcclusionScratch& s) {
    const int n = slice.width;
    std::int64_t* sums = band.lastSquares + static_cast<std::ptrdiff_t>(k) * band.stride;
    if (band.first == 0)
        for (int j = 0; j < slice.radius; ++j) addSquares(sums, slice.row(j), n);
    for (int j = band.first; j < band.end; ++j) {
        if (slice.enters(j)) addSquares(sums, slice.entering(j), n);
        if (slice.leaves(j)) dropSquares(sums, slice.leaving(j), n);
        windowSquares(sums, s.squaresPrefix, band.squares + band.boxRow(j, k), n, band.radius[0]);
    }
}

// Boxes of a strip of row j, along k.
void finishColumns(const OcclusionBand& band, int i, int j, const OcclusionScratch& s) {
    constexpr int n = kOcclusionStrip;
    const int depth = band.size[2], radius = band.radius[2];
    const bool extrema = band.extrema(), moments = band.moments();
    const auto sums = [&](int k) { return band.sums + band.boxRow(j, k) + i; };
    const auto squares = [&](int k) { return band.squares + band.boxRow(j, k) + i; };
    for (int c = 0; c < n; ++c) s.total[c] = 0;
    for (int c = 0; c < n; ++c) s.totalSquares[c] = 0;
    for (int k = 0; k < radius; ++k) {
        exchange(s.total, sums(k), nullptr, n);
        if (moments) exchange(s.totalSquares, squares(k), nullptr, n);
    }
    const std::ptrdiff_t start = extrema ? band.boxRow(j, 0) + i : 0;
    SlidingExtrema<n> sliding({band.lows + start, band.highs + start, band.stride, depth}, radius, 0, depth,
                              n, s);
    const int rows = clippedWindow(j, band.radius[1], band.size[1]);
    for (int k = 0; k < depth; ++k) {
        const int in = k + radius, out = k - radius - 1;
        const bool enters = in < depth, leaves = out >= 0;
        exchange(s.total, enters ? sums(in) : nullptr, leaves ? sums(out) : nullptr, n);
        if (extrema) sliding.next({s.lows, s.highs});
        if (moments)
            exchange(s.totalSquares, enters ? squares(in) : nullptr, leaves ? squares(out) : nullptr, n);
        finishStrip(band, s, i, j, k, static_cast<double>(rows) * clippedWindow(k, radius, depth));
    }
}

}  // namespace

void filterOcclusionSlice(const OcclusionBand& band, int k, const OcclusionScratch& scratch) {
    const int width = band.size[0], height = band.size[1];
    const Slice slice{band.values + static_cast<std::ptrdiff_t>(k) * height * width, width, height,
                      band.radius[1]};
    filterSums(band, slice, k, scratch);
    if (band.extrema()) filterExtrema(band, k, scratch);
    if (band.moments()) filterSquares(band, slice, k, scratch);
}

void finishOcclusionRow(const OcclusionBand& band, int j, const OcclusionScratch& scratch) {
    for (int i = 0; i < band.stride; i += kOcclusionStrip) finishColumns(band, i, j, scratch);
}

}  // namespace stereonav::STEREONAV_ISA
