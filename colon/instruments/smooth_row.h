// A Gaussian over a row of numbers.
#pragma once

#include <vector>

namespace stereonav {

// Smooths a row. sigma: in steps of the row, >= 0. Beyond the ends of an open row the last values count on; a
// closed row goes on at its start.
void smoothRow(std::vector<double>& row, double sigma, bool closed);

}  // namespace stereonav
