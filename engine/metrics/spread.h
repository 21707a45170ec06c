// A figure that was measured several times: its median, least and largest value. Used in charts, tables and
// comparisons with earlier runs.
#pragma once

#include <string>
#include <vector>

namespace stereonav {

struct Spread {
    double median = 0, low = 0, high = 0;  // low and high: the least and the largest of the samples
    int count = 0;                         // samples; 0: not measured

    // Returns half of (high - low) as a share of the median; 0 where the median is 0.
    double relative() const;
};

// Returns the spread of the samples that are finite. Without any: count 0, all zero.
Spread spreadOf(std::vector<double> samples);
// Returns the spread of a figure that is the same in each run.
Spread exactly(double value);
// Returns the spread with every number multiplied by `factor`, above 0, as for other units.
Spread scaled(const Spread& spread, double factor);

// Return "1.23" and "1.23 (1.20 to 1.31)": three significant digits.
std::string numberText(double value);
std::string spreadText(const Spread& spread);

}  // namespace stereonav
