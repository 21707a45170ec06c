// How far pictures of one combination may be apart, by what it shows.
#pragma once

#include <optional>

#include "tests/combinations/judging.h"
#include "tests/combinations/model.h"

namespace stereonav::test {

// Between instruction sets, both eyes cast in full.
Nearness betweenSets(const Row& row);

// Plain kernels beside the oracle, both eyes in full.
Nearness besideOracle(const Row& row);
// A colon's wall is cast as far as it is known, the oracle goes on behind it.
bool isOfManyLayers(const Row& row);

// Right eyes beside one cast in full, by the same instruction set; nothing where the method is to be wrong.
std::optional<Range> rangeOfRight(const Row& row);
std::optional<Nearness> nearnessOfRight(const Row& row);

// Which way is taken, and in which size, depends on what takes how long.
bool isTimed(const Row& row);

}  // namespace stereonav::test
