#include "tests/combinations/bounds.h"

#include <algorithm>

namespace stereonav::test {

bool isTimed(const Row& row) {
    return levelOf(row, Factor::Quality) == "time";
}
bool isDrawnOnceOnly(const Row& row) {
    const std::string& light = levelOf(row, Factor::Light);
    return isTimed(row) || (given(row, Factor::Quality) && (light == "lazy" || light == "lazy-transfer"));
}

namespace {

// In a picture of one pixel a rounding of a step in each channel is a mean of 1.
double mean(const Row& row, double ofMany) {
    return levelOf(row, Factor::Size) == "1x1" ? std::max(ofMany, 1.0) : ofMany;
}

// Noise a thousandth as large as the scene's detail repeats after 8 cm on a terrain: at a kilometre floats
// tell places 0.06 mm apart, a fortieth of a texel. A hundred times as large, the same pictures differ by no
// step.
bool isNoiseTooFine(const Row& row) {
    return levelOf(row, Factor::Noise) == "fine";
}

// Tissue in a cloud: what is opaque after millimetres, in samples that are tens of metres apart. A sample is
// there or is not, and where its place is within floats of the edge so is a texel of the light, of which
// there are 24 a side: of 25 pairs of eyes, 120 m apart within 2 m, two differ so, by 1.8 steps on average
// over some 50 pixels; the others by 0.003.
bool hasSharpEdgesInLight(const Row& row) {
    const std::string& model = levelOf(row, Factor::Model);
    return levelOf(row, Factor::Scene) == "cloud" && given(row, Factor::Medium) && model != "emission" &&
           model != "surface";
}

}  // namespace

// Kernels hold 10 bits of light, of normals and of places within cells: a step or two of a packed channel
// each, as their own tests say (tests/volume, tests/terrain). Roundings that decide which cell a ray meets
// first, or whether a shadow ray meets one, fall out differently on edges. Measured of all triples: 1 step,
// 0.01 on average; light that is traced 0.08; noise that is too fine 13 steps, 0.92.
Nearness betweenSets(const Row& row) {
    // A path that meets an edge, or just misses it, goes another way.
    if (levelOf(row, Factor::Light) == "traced") return {4, 0.05, mean(row, 0.5)};
    if (isNoiseTooFine(row)) return {16, 0.02, mean(row, 1.5)};
    return {2, 0.005, mean(row, 0.05)};
}

// Corner normals are kept to 10 bits and mixed with 15-bit weights, light of sweeps is kept in 15 bits.
// Edges that one of the two just misses, and what casts a shadow from less than a voxel away, may differ by
// all there is. Measured of all triples: 1 step, 0.23 on average; with shadows 1.05; noise that is too fine
// 17 steps, 1.8.
Nearness besideOracle(const Row& row) {
    if (isNoiseTooFine(row)) return {20, 0.02, 2.5};
    if (hasSharpEdgesInLight(row)) return {2, 0.03, mean(row, 2.5)};
    const bool shadows = levelOf(row, Factor::Shading).ends_with("-shadows");
    return {2, shadows ? 0.06 : 0.02, mean(row, shadows ? 2.0 : 0.4)};
}
bool isShadedBetweenPlaces(const Row& row) {
    return showsMedium(row) && !isTerrain(row) && !given(row, Factor::Noise) &&
           levelOf(row, Factor::Model) != "emission" && levelOf(row, Factor::Fineness) != "each";
}
// Places lie as close together as a voxel only where a picture has many rows, and right before an eye. The
// studies are some twenty voxels across: a step of values is over within one voxel, and with it the gradient
// that shading follows. Measured: 7 steps, 0.81 on average; where the surface is all there is 54 and 5.5; of
// few rows, where a wall is right before an eye, 1 and 0.04 in one of 149 pictures, none in the others.
Nearness besideEachSample(const Row& row) {
    if (levelOf(row, Factor::Size) != "17x64") return {1, 0, 0.1};
    if (levelOf(row, Factor::Model) == "surface") return {60, 0.02, 6.5};
    return {8, 0.02, 1.0};
}
// Only where rays begin differs.
Nearness besidePlainEdges(const Row& row) {
    return {2, 0.005, mean(row, 0.05)};
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
    // again are resampled with the colours. Measured of all triples: 7 steps and, of the paper's splats in a
    // picture 178 degrees wide, 9.
    return Range{method == "paper" ? 2 : 1, 10, 0.02};
}

bool edgesDecideColours(const Row& row) {
    return levelOf(row, Factor::Size) == "64x1";
}

std::optional<Nearness> nearnessOfRight(const Row& row) {
    const std::string& method = levelOf(row, Factor::Method);
    if (method == "full" || method == "two-sweeps" || method == "own-samples") return Nearness{0, 0, 0};
    return std::nullopt;
}

}  // namespace stereonav::test
