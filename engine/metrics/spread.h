// A figure that was measured several times: its median and between what it lay. What charts, tables and
// comparisons with earlier runs are made of.
#pragma once

#include <string>
#include <vector>

namespace stereonav {

struct Spread {
    double median = 0, low = 0, high = 0;  // low and high: the least and the largest of the samples
    int count = 0;                         // samples; 0: not measured

    // Half the distance of the ends as a share of the median; 0 where the median is 0.
    double relative() const;
};

// Returns the spread of samples, those left out that are not finite. None left: count 0, all zero.
Spread spreadOf(std::vector<double> samples);
// Returns the spread of a figure that repeats exactly.
Spread exactly(double value);
// Returns every number times `factor`, above 0: other units.
Spread scaled(const Spread& spread, double factor);

// Return "1.23" and "1.23 (1.20 to 1.31)": three digits that count.
std::string numberText(double value);
std::string spreadText(const Spread& spread);

}  // namespace stereonav
