// A transfer function as the renderers read it: evenly spaced entries, linear between them. What a medium's
// properties are is defined by this table, so that plain code, kernels and shaders agree.
#pragma once

#include <vector>

#include "engine/medium/model/medium_transfer.h"

namespace stereonav {

struct MediumTable {
    static constexpr int kValues = 1024;   // intervals along the value
    static constexpr int kGradients = 64;  // intervals along the gradient magnitude, where that matters

    double firstValue = 0, perValue = 0;  // entry = (value - firstValue) * perValue, clamped to 0 .. kValues
    double perGradient = 0;               // row = gradient * perGradient, clamped to 0 .. rows - 1
    int rows = 1;                         // kGradients + 1 with a gradient, else 1
    // Rows of kValues + 1. Empty ones have the colour of the nearest that is not, so that none bleeds.
    std::vector<OpticalProperties> entries;
    std::vector<float> largest;  // extinction, 1 / metres, of each column, over the rows; kValues + 1

    bool usesGradient() const { return rows > 1; }
    // value, gradient: in value units, value units a metre.
    OpticalProperties at(double value, double gradient) const;
    // Returns the largest extinction, 1 / metres, between two values, over every gradient: a bound for
    // skipping and for delta tracking.
    float largestExtinction(double lowest, double highest) const;
    // Returns the values between which something is not empty for some gradient; lowest > highest where all
    // is empty; ends may be infinite. By the table, which reaches an entry further than the transfer
    // function.
    MediumTransfer::Range visibleRange() const;
};

// Makes the table over the visible values that lie within [lowest, highest], those of the data. Entries lie
// on whole values where they can (a range of up to kValues), so that whole numbers are looked up exactly;
// else a step of the function becomes a ramp of up to two entries, and what is narrower than an entry may be
// missed.
MediumTable makeMediumTable(const MediumTransfer& transfer, double lowest, double highest);

}  // namespace stereonav
