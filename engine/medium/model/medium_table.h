// A transfer function in the form that renderers read: evenly spaced entries, linear between them. This table
// defines a medium's properties, so that plain code, kernels and shaders agree.
#pragma once

#include <vector>

#include "engine/medium/model/medium_transfer.h"

namespace stereonav {

struct MediumTable {
    static constexpr int kValues = 1024;   // intervals along the value
    static constexpr int kGradients = 64;  // intervals along the gradient magnitude, where it matters

    double firstValue = 0, perValue = 0;  // entry = (value - firstValue) * perValue, clamped to 0 .. kValues
    double perGradient = 0;               // row = gradient * perGradient, clamped to 0 .. rows - 1
    int rows = 1;                         // kGradients + 1 with a gradient, else 1
    // Rows of kValues + 1. Empty entries have the colour of the nearest entry that is not empty, so that
    // interpolation does not bleed.
    std::vector<OpticalProperties> entries;
    std::vector<float> largest;  // largest extinction in each column over the rows, 1 / metres; kValues + 1

    bool usesGradient() const { return rows > 1; }
    // Returns the properties. value: value units; gradient: value units per metre.
    OpticalProperties at(double value, double gradient) const;
    // Returns the largest extinction, 1 / metres, between two values, over every gradient: a bound for
    // skipping and for delta tracking.
    float largestExtinction(double lowest, double highest) const;
    // Returns the range of values in which the medium is not empty for some gradient; lowest > highest where
    // all is empty; ends may be infinite. By interpolation the table reaches an entry farther than the
    // transfer function.
    MediumTransfer::Range visibleRange() const;
};

// Makes the table over the visible values that lie within [lowest, highest], the range of the data. Where the
// range has up to kValues units, entries lie on whole values, so that whole numbers are looked up exactly.
// Otherwise a step of the function becomes a ramp of up to two entries, and features narrower than an entry
// may be missed.
MediumTable makeMediumTable(const MediumTransfer& transfer, double lowest, double highest);

}  // namespace stereonav
