// Smooths a row of numbers with a Gaussian.
#pragma once

#include <vector>

namespace stereonav {

// Smooths a row. sigma: in steps of the row, >= 0. An open row is continued beyond its ends with the last
// values; a closed row continues at its start.
void smoothRow(std::vector<double>& row, double sigma, bool closed);

}  // namespace stereonav
