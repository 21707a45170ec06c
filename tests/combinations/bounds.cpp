#include "tests/combinations/bounds.h"

namespace stereonav::test {

bool isTimed(const Row& row) {
    return levelOf(row, Factor::Quality) == "time";
}
bool isDrawnOnceOnly(const Row& row) {
    const std::string& light = levelOf(row, Factor::Light);
    return isTimed(row) || (given(row, Factor::Quality) && (light == "lazy" || light == "lazy-transfer"));
}

// Kernels hold 10 bits of light, of normals and of places within cells: a step or two of a packed channel
// each, as their own tests say (tests/volume, tests/terrain). Roundings that decide which cell a ray meets
// first, or whether a shadow ray meets one, fall out differently on edges.
Nearness betweenSets(const Row& row) {
    // A path that meets an edge, or just misses it, goes another way.
    if (levelOf(row, Factor::Light) == "traced") return {64, 0.05, 4.0};
    // Noise moves places: which side of a layer's face one of them is on is up to a rounding.
    if (given(row, Factor::Noise)) return {12, 0.01, 0.5};
    return {4, 0.005, 0.5};
}

// Corner normals are kept to 10 bits and mixed with 15-bit weights, light of sweeps is kept in 15 bits: 6
// steps, as in the tests of those kernels. Edges that one of the two just misses, and what casts a shadow
// from less than a voxel away, may differ by all there is.
Nearness besideOracle(const Row& row) {
    const bool shadows = levelOf(row, Factor::Shading).ends_with("-shadows");
    return {6, shadows ? 0.06 : 0.02, shadows ? 6.0 : 1.0};
}
bool isShadedBetweenPlaces(const Row& row) {
    return showsMedium(row) && !isTerrain(row) && !given(row, Factor::Noise) &&
           levelOf(row, Factor::Model) != "emission" && levelOf(row, Factor::Fineness) != "each";
}
Nearness besideEachSample(const Row&) {
    return {6, 0.02, 1.0};
}
bool isSeenOtherwiseByOracle(const Row& row) {
    return isColon(row) && (given(row, Factor::Opacity) || levelOf(row, Factor::Size) == "64x1");
}

// A warped pixel lies between two of the left eye that are at most 1.4 of its own pixels apart, and a hole's
// is cast: its colour is one that a full cast has within a pixel of it, but for light that is shaded again
// from resampled normals. Translucent pixels are gathered from many depths: only selective and depthsplat
// know about that.
std::optional<Range> rangeOfRight(const Row& row) {
    const std::string& method = levelOf(row, Factor::Method);
    if (method == "mcmillan" || method == "nofill" || isTimed(row)) return std::nullopt;
    const bool layers =
        given(row, Factor::Opacity) && (method == "paper" || method == "linear" || method == "cubic");
    if (layers) return std::nullopt;
    // The paper's splats add up what lies within two pixels. Normals that highlights are worked out from
    // again are resampled with the colours.
    return Range{method == "paper" ? 2 : 1, given(row, Factor::Highlight) ? 40 : 24, 0.02};
}

std::optional<Nearness> nearnessOfRight(const Row& row) {
    const std::string& method = levelOf(row, Factor::Method);
    if (method == "full" || method == "two-sweeps" || method == "own-samples") return Nearness{0, 0, 0};
    return std::nullopt;
}

}  // namespace stereonav::test
