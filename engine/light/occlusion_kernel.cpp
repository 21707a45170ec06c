// Sums, minima and maxima of boxes and the openness made of them, for one instruction set. Along j and k
// whole rows are combined: running sums, and minima and maxima by van Herk 1992 / Gil and Werman 1993 (three
// comparisons a voxel whatever the radius). Along i sums are differences of a running sum and extrema are
// found by doubling the window (log2 of it steps on whole vectors: less work than one by one at any radius).
// No contraction and no approximate instruction: all instruction sets give the same bytes.
#include "engine/light/occlusion_kernel_types.h"
#include "engine/math/simd.h"

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

void setNone(Extrema to, int n) {
    for (int i = 0; i < n; ++i) to.low[i] = kNoLow;
    for (int i = 0; i < n; ++i) to.high[i] = kNoHigh;
}

// to = a with b; b may be one row of values or a pair of rows.
void combine(const Int16* __restrict aLow, const Int16* __restrict aHigh, const Int16* bLow,
             const Int16* bHigh, Extrema to, int n) {
    Int16* __restrict low = to.low, * __restrict high = to.high;
    for (int i = 0; i < n; ++i) low[i] = aLow[i] < bLow[i] ? aLow[i] : bLow[i];
    for (int i = 0; i < n; ++i) high[i] = aHigh[i] > bHigh[i] ? aHigh[i] : bHigh[i];
}

void widen(Extrema run, const Int16* __restrict bLow, const Int16* __restrict bHigh, int n) {
    Int16* __restrict low = run.low, * __restrict high = run.high;
    for (int i = 0; i < n; ++i) low[i] = low[i] < bLow[i] ? low[i] : bLow[i];
    for (int i = 0; i < n; ++i) high[i] = high[i] > bHigh[i] ? high[i] : bHigh[i];
}

// Rows of an image: low and high of row j at low + j * pitch; both are the same for plain values.
struct Rows {
    const Int16 *low, *high;
    std::ptrdiff_t pitch;
    int count;  // rows outside [0, count) hold nothing
};

// Extrema of rows j - radius .. j + radius, for rising j. Blocks of a window's length start at the first
// row's window; a window is the suffix of one block and the prefix of the next.
class SlidingExtrema {
public:
    SlidingExtrema(const Rows& rows, int radius, int first, int n, const OcclusionScratch& scratch)
        : mRows(rows), mWindow(2 * radius + 1), mStart(first - radius), mN(n), mScratch(scratch) {
        startBlock();
    }

    // The next row's.
    STEREONAV_INLINE void next(Extrema to) {
        if (mAt == mWindow) {
            mStart += mWindow;
            startBlock();
        }
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(mAt) * mN;
        if (mAt > 0) {
            const int entering = mStart + mWindow + mAt - 1;
            if (entering >= 0 && entering < mRows.count)
                widen(run(), mRows.low + entering * mRows.pitch, mRows.high + entering * mRows.pitch, mN);
        }
        combine(mScratch.suffixLows + at, mScratch.suffixHighs + at, mScratch.runLows, mScratch.runHighs, to,
                mN);
        ++mAt;
    }

private:
    STEREONAV_INLINE Extrema run() const { return {mScratch.runLows, mScratch.runHighs}; }
    STEREONAV_INLINE Extrema suffix(int at) const {
        return {mScratch.suffixLows + static_cast<std::ptrdiff_t>(at) * mN,
                mScratch.suffixHighs + static_cast<std::ptrdiff_t>(at) * mN};
    }

    void startBlock() {
        mAt = 0;
        setNone(run(), mN);
        for (int at = mWindow - 1; at >= 0; --at) {
            const int row = mStart + at;
            const bool inside = row >= 0 && row < mRows.count;
            const Extrema behind = at + 1 < mWindow ? suffix(at + 1) : run();
            const std::ptrdiff_t offset = row * mRows.pitch;
            combine(behind.low, behind.high, inside ? mRows.low + offset : behind.low,
                    inside ? mRows.high + offset : behind.high, suffix(at), mN);
        }
    }

    Rows mRows;
    int mWindow, mStart, mN, mAt = 0;
    const OcclusionScratch& mScratch;
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

// As doubles, by setting the mantissa: exact for whole numbers below 2^52, and vectors can do it everywhere.
void windowSquares(const std::int64_t* sums, std::uint64_t* prefix, double* __restrict to, int n,
                   int radius) {
    fillPrefix(sums, prefix, n, radius);
    const std::uint64_t *ahead = prefix + 2 * radius + 1, *behind = prefix;
    for (int i = 0; i < n; ++i)
        to[i] =
            __builtin_bit_cast(double, (ahead[i] - behind[i]) | 0x4330000000000000ull) - 4503599627370496.0;
}

// ---- along k

STEREONAV_INLINE D loadD(const double* p) {
    D d;
    __builtin_memcpy(&d, p, sizeof d);
    return d;
}
STEREONAV_INLINE void store(double* p, D d) {
    __builtin_memcpy(p, &d, sizeof d);
}

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
    const I raw = asInt(t) - I(0x3f3504f3);       // of sqrt(1/2)
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
STEREONAV_INLINE F reconstructed(bool turned, I value, I low, I high, D sum, D count) {
    const D lowest = count * toDouble(low), highest = count * toDouble(high);
    const F below = toFloat(turned ? highest - sum : sum - lowest);
    const F above = toFloat(turned ? sum - lowest : highest - sum);
    const I range = high - low, place = turned ? high - value : value - low;
    const F t = toFloat(place) / toFloat(range);
    const F open = exp2Of(below / above * log2Of(t));
    const F ends = select(place == I(0), F(0.0f), open);
    return select(range == I(0), F(0.5f), ends);
}

struct Moments {
    F away, variance;  // of the value from the mean, upwards in density; stored numbers
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
    if (band.extrema())
        return reconstructed(band.turned, value, loadI(s.low + i), loadI(s.high + i), sum, count);
    const Moments box = moments(band.turned, value, sum, loadD(s.totalSquares + i), count);
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

// The row (j, k) of results; s holds its boxes.
void finish(const OcclusionBand& band, const OcclusionScratch& s, int j, int k, double rows) {
    const std::ptrdiff_t at = (static_cast<std::ptrdiff_t>(k) * band.size[1] + j) * band.size[0];
    toInt32(band.values + at, s.value, band.size[0]);
    if (band.extrema()) {
        toInt32(s.lows, s.low, band.size[0]);
        toInt32(s.highs, s.high, band.size[0]);
    }
    for (int i = 0; i < band.stride; i += kLanes)
        store(s.out + i, inBytes(resultOf(band, s, i, loadD(band.columnCounts + i) * D(rows))));
    toBytes(s.out, band.to + at, band.size[0]);
}

STEREONAV_INLINE int clippedWindow(int at, int radius, int size) {
    return least(at + radius, size - 1) - most(at - radius, 0) + 1;
}

}  // namespace

void filterOcclusionSlice(const OcclusionBand& band, int k, const OcclusionScratch& s) {
    const int n = band.size[0], height = band.size[1], radius = band.radius[1];
    const Int16* slice = band.values + static_cast<std::ptrdiff_t>(k) * height * n;
    const auto row = [&](int j) { return slice + static_cast<std::ptrdiff_t>(j) * n; };
    for (int i = 0; i < n; ++i) s.sums[i] = 0;
    for (int i = 0; i < n; ++i) s.squares[i] = 0;
    const bool extrema = band.extrema();
    for (int j = most(band.first - radius, 0); j < least(band.first + radius, height); ++j) {
        addRow(s.sums, row(j), n);
        if (!extrema) addSquares(s.squares, row(j), n);
    }
    const int reach = band.radius[0], window = 2 * reach + 1;
    const Extrema ends[2] = {{s.lows, s.highs}, {s.lows + reach + n, s.highs + reach + n}};
    const Extrema middle{s.lows + reach, s.highs + reach};
    // Only made where it is used: it begins with work.
    SlidingExtrema sliding({slice, slice, n, extrema ? height : 0}, extrema ? radius : 0, band.first, n, s);
    for (int j = band.first; j < band.end; ++j) {
        const std::ptrdiff_t to = band.boxRow(j, k);
        const int in = j + radius, out = j - radius - 1;
        const bool enters = in < height, leaves = out >= 0 && j > band.first;
        if (enters && leaves)
            exchangeRow(s.sums, row(in), row(out), n);
        else if (enters)
            addRow(s.sums, row(in), n);
        else if (leaves)
            dropRow(s.sums, row(out), n);
        windowSums(s.sums, s.prefix, band.sums + to, n, reach);
        if (extrema) {
            sliding.next(middle);
            for (const Extrema& end : ends) setNone(end, reach);
            leastOfWindows(s.lows, band.lows + to, n, window);
            mostOfWindows(s.highs, band.highs + to, n, window);
        } else {
            if (enters) addSquares(s.squares, row(in), n);
            if (leaves) dropSquares(s.squares, row(out), n);
            windowSquares(s.squares, s.squaresPrefix, band.squares + to, n, reach);
        }
    }
}

void finishOcclusionRow(const OcclusionBand& band, int j, const OcclusionScratch& s) {
    const int n = band.stride, depth = band.size[2], radius = band.radius[2];
    const bool extrema = band.extrema();
    const auto sums = [&](int k) { return band.sums + band.boxRow(j, k); };
    const auto squares = [&](int k) { return band.squares + band.boxRow(j, k); };
    for (int i = 0; i < n; ++i) s.total[i] = 0;
    for (int i = 0; i < n; ++i) s.totalSquares[i] = 0;
    for (int k = 0; k < least(radius, depth); ++k) {
        exchange(s.total, sums(k), nullptr, n);
        if (!extrema) exchange(s.totalSquares, squares(k), nullptr, n);
    }
    const std::ptrdiff_t start = band.boxRow(j, 0);
    SlidingExtrema sliding({extrema ? band.lows + start : nullptr, extrema ? band.highs + start : nullptr, n,
                            extrema ? depth : 0},
                           extrema ? radius : 0, 0, n, s);
    const int rows = clippedWindow(j, band.radius[1], band.size[1]);
    for (int k = 0; k < depth; ++k) {
        const int in = k + radius, out = k - radius - 1;
        const bool enters = in < depth, leaves = out >= 0;
        exchange(s.total, enters ? sums(in) : nullptr, leaves ? sums(out) : nullptr, n);
        if (extrema)
            sliding.next({s.lows, s.highs});
        else
            exchange(s.totalSquares, enters ? squares(in) : nullptr, leaves ? squares(out) : nullptr, n);
        finish(band, s, j, k, static_cast<double>(rows) * clippedWindow(k, radius, depth));
    }
}

}  // namespace stereonav::STEREONAV_ISA
