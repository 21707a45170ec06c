// A transfer function as the renderers read it: evenly spaced entries, linear between them. What a medium's
// properties are is defined by this table, so that plain code, kernels and shaders agree.
#pragma once

#include <vector>

#include "engine/medium/medium_transfer.h"

namespace stereonav {

struct MediumTable {
    static constexpr int kValues = 1024;   // intervals along the value
    static constexpr int kGradients = 64;  // intervals along the gradient magnitude, where that matters

    double firstValue = 0, perValue = 0;  // entry = (value - firstValue) * perValue, clamped to 0 .. kValues
    double perGradient = 0;               // row = gradient * perGradient, clamped to 0 .. rows - 1
    int rows = 1;                         // kGradients + 1 with a gradient, else 1
    std::vector<OpticalProperties> entries;  // rows of kValues + 1

    bool usesGradient() const { return rows > 1; }
    OpticalProperties at(double value, double gradient) const;
    // Largest extinction between two values, over every gradient: a bound for skipping and for delta
    // tracking.
    float largestExtinction(double lowest, double highest) const;
};

// Over the visible values that lie within [lowest, highest], those of the data.
MediumTable makeMediumTable(const MediumTransfer& transfer, double lowest, double highest);

}  // namespace stereonav
