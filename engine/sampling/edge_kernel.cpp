// Few pixels are edges, and colours alone rule most of them out: depths are read where a vector has a pixel
// left.
#include "engine/sampling/edge_row.h"
#include "engine/simd/simd.h"
#include "engine/simd/simd_rows.h"

namespace stereonav::STEREONAV_ISA {
namespace {

// The pixels x .. x + kLanes - 1 with those beside them.
template <typename T>
struct Neighbours {
    T at, left, right, above, below;
};

// 1 / depth; 0 where nothing was hit, as of infinite depth. Meaningless where it is not known.
STEREONAV_INLINE M known(F depth) {
    return depth > F(0.0f);
}

// By how much 1 / depth is bent between three pixels, and the largest of them. Where one of them is not known
// it is any number.
struct Bend {
    F by, largest;
    STEREONAV_INLINE Bend(F before, F at, F after)
        : by(abs((before + after) - (at + at))), largest(max(max(before, after), at)) {}
    STEREONAV_INLINE M beyond(float share) const { return by > F(share) * largest; }
};

// Returns whether a channel of the pixel differs from that of one of its neighbours by more than `most`.
// Channels are compared where they lie in the colour.
STEREONAV_INLINE M differs(const Neighbours<I>& color, int most) {
    const auto channel = [&](int shift) {
        const I field(1023 << shift);
        const I left = color.left & field, right = color.right & field, above = color.above & field,
                below = color.below & field, at = color.at & field;
        const I largest = max(max(left, right), max(above, below));
        const I least = min(min(left, right), min(above, below));
        return max(largest - at, at - least) > I(most << shift);
    };
    return channel(0) | channel(10) | channel(20);
}

STEREONAV_INLINE M edges(const EdgeRow& r, const Neighbours<I>& color, const Neighbours<F>& depth,
                         bool inner) {
    const Neighbours<M> there{known(depth.at), known(depth.left), known(depth.right), known(depth.above),
                              known(depth.below)};
    // A neighbour that is not known is as the pixel itself: it does not differ.
    const auto beside = [&](M m, I c) { return select(m, c, color.at); };
    const Neighbours<I> seen{color.at, beside(there.left, color.left), beside(there.right, color.right),
                             beside(there.above, color.above), beside(there.below, color.below)};
    const F one(1.0f), at = one / depth.at;
    const Bend across(one / depth.left, at, one / depth.right),
        down(one / depth.above, at, one / depth.below);
    const M row = there.left & there.right;
    const M column = inner ? there.above & there.below : firstLanes(0);
    const auto bent = [&](float share) {
        return (row & across.beyond(share)) | (column & down.beyond(share));
    };
    return there.at &
           ((bent(r.depthBreak) & differs(seen, r.contrast - 1)) |
            (bent(r.depthJump) & differs(seen, r.jumpContrast - 1)) | differs(seen, r.strongContrast - 1));
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
    const auto bent = [&](float b, float a, float share) {
        const float second = (b + a) - (at + at), largest = b > a ? b : a;
        return b >= 0 && a >= 0 && (second < 0 ? -second : second) > share * (largest > at ? largest : at);
    };
    const auto isBent = [&](float share) {
        return bent(near[0], near[1], share) || bent(near[2], near[3], share);
    };
    return (difference >= r.contrast && isBent(r.depthBreak)) ||
           (difference >= r.jumpContrast && isBent(r.depthJump)) || difference >= r.strongContrast;
}

}  // namespace

void findEdges(const EdgeRow& r) {
    const bool inner = r.above && r.below;
    const std::uint32_t* const above = r.above ? r.above : r.row;
    const std::uint32_t* const below = r.below ? r.below : r.row;
    const float* const depthAbove = r.depthAbove ? r.depthAbove : r.depth;
    const float* const depthBelow = r.depthBelow ? r.depthBelow : r.depth;
    const int weaker = r.contrast < r.jumpContrast ? r.contrast : r.jumpContrast;
    const int least = (weaker < r.strongContrast ? weaker : r.strongContrast) - 1;
    const auto one = [&](int x) { r.edges[x] = isEdge(r, x) ? 255 : 0; };
    one(0);
    int x = 1;
    for (; x + kLanes < r.width; x += kLanes) {
        const Neighbours<I> color{loadI(r.row + x), loadI(r.row + x - 1), loadI(r.row + x + 1),
                                  loadI(above + x), loadI(below + x)};
        M edge = differs(color, least);
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
