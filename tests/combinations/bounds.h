// How far pictures of one combination may be apart, by what it shows.
#pragma once

#include <optional>

#include "tests/combinations/judging.h"
#include "tests/combinations/model.h"

namespace stereonav::test {

// How near instruction sets are to each other, both eyes cast in full.
Nearness betweenSets(const Row& row);

// How near plain kernels are to the oracle, both eyes in full.
Nearness besideOracle(const Row& row);
// A medium whose surfaces are shaded at places and between them; the oracle shades each sample.
bool isShadedBetweenPlaces(const Row& row);
// Returns the bounds for a comparison with shading each sample.
Nearness besideEachSample(const Row& row);
// A colon's wall is known, and cast, a few voxels deep; the oracle goes on behind it. What begins behind it
// is that of 64x1 pixels, 178 degrees across, whose near plane cuts the wall.
bool isSeenOtherwiseByOracle(const Row& row);

// How near rays at edges are to whole pictures cast through the same places.
Nearness besidePlainEdges(const Row& row);

// How far right eyes are from one cast in full, by the same instruction set; none where the method is to be
// wrong.
std::optional<Range> rangeOfRight(const Row& row);
// Pixels many times as tall as they are wide: rays added at an edge see what the pixel's own ray and its
// neighbours are far from, and whether two pixels beside a contrast are an edge falls out differently in a
// warped picture.
bool edgesDecideColours(const Row& row);
std::optional<Nearness> nearnessOfRight(const Row& row);

// Which way is taken, and in which size, depends on what takes how long.
bool isTimed(const Row& row);
// What is drawn depends on what was before: on times, or on whether the scene that is measured for its
// quality had its light already.
bool isDrawnOnceOnly(const Row& row);

}  // namespace stereonav::test
