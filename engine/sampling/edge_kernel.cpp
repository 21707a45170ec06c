// Few pixels are edges, and colours alone rule most of them out: depths are read where a vector has a pixel
// left.
#include "engine/sampling/edge_row.h"
#include "engine/simd/simd.h"
#include "engine/simd/simd_rows.h"

namespace stereonav::STEREONAV_ISA {
namespace {

STEREONAV_INLINE I apart(I a, I b) {
    return max(a, b) - min(a, b);
}

struct Channels {
    I r, g, b;
    STEREONAV_INLINE explicit Channels(I color)
        : r(color & I(1023)), g(shiftRight<10>(color) & I(1023)), b(shiftRight<20>(color) & I(1023)) {}
};

STEREONAV_INLINE I contrast(const Channels& a, const Channels& b) {
    return max(apart(a.r, b.r), max(apart(a.g, b.g), apart(a.b, b.b)));
}

// The pixels x .. x + kLanes - 1 with those beside them.
template <typename T>
struct Neighbours {
    T at, left, right, above, below;
};

// 1 / depth; 0 where nothing was hit, as of infinite depth. Meaningless where it is not known.
STEREONAV_INLINE M known(F depth) {
    return depth > F(0.0f);
}

// Whether 1 / depth is bent between three pixels by more than the share of the largest. Where one of them is
// not known nothing is bent.
STEREONAV_INLINE M bent(F before, F at, F after, float share) {
    const F b = F(1.0f) / before, m = F(1.0f) / at, a = F(1.0f) / after;
    return (abs((b + a) - (m + m)) > F(share) * max(max(b, a), m)) & known(before) & known(at) & known(after);
}

STEREONAV_INLINE M edges(const EdgeRow& r, const Neighbours<I>& color, const Neighbours<F>& depth,
                         bool inner) {
    const Channels at(color.at);
    const auto to = [&](I beside, F beyond) { return keep(known(beyond), contrast(at, Channels(beside))); };
    const I difference = max(max(to(color.left, depth.left), to(color.right, depth.right)),
                             max(to(color.above, depth.above), to(color.below, depth.below)));
    M broken = bent(depth.left, depth.at, depth.right, r.depthBreak);
    if (inner) broken = broken | bent(depth.above, depth.at, depth.below, r.depthBreak);
    const M edge = (broken & (difference > I(r.contrast - 1))) | (difference > I(r.strongContrast - 1));
    return edge & known(depth.at);
}

STEREONAV_INLINE std::int32_t apart(std::uint32_t a, std::uint32_t b, int shift) {
    const auto d =
        static_cast<std::int32_t>(a >> shift & 1023u) - static_cast<std::int32_t>(b >> shift & 1023u);
    return d < 0 ? -d : d;
}

// One pixel, at the ends of the row. Beyond the picture's border nothing is known.
inline bool isEdge(const EdgeRow& r, int x) {
    constexpr float kUnknown = 0;
    const int beside[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const std::uint32_t* const colors[3] = {r.above, r.row, r.below};
    const float* const depths[3] = {r.depthAbove, r.depth, r.depthBelow};
    if (!(r.depth[x] > 0)) return false;
    std::int32_t difference = 0;
    float near[4];
    for (int k = 0; k < 4; ++k) {
        const int column = x + beside[k][0], row = 1 + beside[k][1];
        const bool there = column >= 0 && column < r.width && colors[row];
        const float depth = there ? depths[row][column] : kUnknown;
        near[k] = depth > 0 ? 1 / depth : -1.0f;
        for (int shift = 0; depth > 0 && shift < 30; shift += 10) {
            const std::int32_t d = apart(r.row[x], colors[row][column], shift);
            difference = d > difference ? d : difference;
        }
    }
    const float at = 1 / r.depth[x];
    const auto bentBetween = [&](float b, float a) {
        const float second = (b + a) - (at + at), largest = b > a ? b : a;
        return b >= 0 && a >= 0 &&
               (second < 0 ? -second : second) > r.depthBreak * (largest > at ? largest : at);
    };
    const bool broken = bentBetween(near[0], near[1]) || bentBetween(near[2], near[3]);
    return (broken && difference >= r.contrast) || difference >= r.strongContrast;
}

}  // namespace

void findEdges(const EdgeRow& r) {
    const bool inner = r.above && r.below;
    const std::uint32_t* const above = r.above ? r.above : r.row;
    const std::uint32_t* const below = r.below ? r.below : r.row;
    const float* const depthAbove = r.depthAbove ? r.depthAbove : r.depth;
    const float* const depthBelow = r.depthBelow ? r.depthBelow : r.depth;
    const I least((r.contrast < r.strongContrast ? r.contrast : r.strongContrast) - 1);
    const auto one = [&](int x) { r.edges[x] = isEdge(r, x) ? 255 : 0; };
    one(0);
    int x = 1;
    for (; x + kLanes < r.width; x += kLanes) {
        const Neighbours<I> color{loadI(r.row + x), loadI(r.row + x - 1), loadI(r.row + x + 1),
                                  loadI(above + x), loadI(below + x)};
        const Channels at(color.at);
        const I difference =
            max(max(contrast(at, Channels(color.left)), contrast(at, Channels(color.right))),
                max(contrast(at, Channels(color.above)), contrast(at, Channels(color.below))));
        M edge = difference > least;
        if (any(edge)) {
            const Neighbours<F> depth{loadF(r.depth + x), loadF(r.depth + x - 1), loadF(r.depth + x + 1),
                                      loadF(depthAbove + x), loadF(depthBelow + x)};
            edge = edge & edges(r, color, depth, inner);
        }
        storeBytes(r.edges + x, edge);
    }
    for (; x < r.width; ++x) one(x);
}

}  // namespace stereonav::STEREONAV_ISA
