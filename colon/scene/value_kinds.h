// What kinds of values a volume has: air or background, what is soft, what is dense. The surface that is
// shown is chosen by it, and presets of transfer functions are fitted to it.
#pragma once

#include <string>

#include "engine/volume/value_counts.h"

namespace stereonav {

constexpr double kWaterOfShifted = 1024;  // value of water in CT whose numbers begin at air

struct ValueKinds {
    bool hounsfield = false;         // Hounsfield units
    bool shifted = false;            // CT with 1024 added, so that air is near 0
    bool mask = false;               // two values
    double lowest = 0, highest = 0;  // values
    double spacing = 0.001;          // metres between voxels: edge of a cube of their volume
    // The value from which on something is no background, and that from which on it is dense; for values in
    // Hounsfield units those of skin and bone. lowest <= object <= dense <= highest unless in these.
    double object = 0, dense = 0;

    // Returns "HU from -1024 to 3071", "values from 0 to 255".
    std::string text() const;
    bool operator==(const ValueKinds&) const = default;
};

// counts: of the whole volume, not empty. hounsfield: whether values are Hounsfield units. frame: the
// volume's.
ValueKinds kindsOf(const ValueCounts& counts, bool hounsfield, const VolumeFrame& frame);

// A value for the surface, and the reason.
struct IsovalueChoice {
    double isovalue = 0;  // the volume's values (HU for CT)
    std::string why;      // one clause
};
// Chooses the isovalue. Hounsfield units: bone where there is some, from 200, 250 or 300 HU on, the lowest
// that adds no more than the rims of bones; else skin. Other volumes: the lower one of the two thresholds
// that part values into the three classes that differ most (Otsu 1979), moved into the valley of the
// histogram near it, so that what is thin stays.
IsovalueChoice isovalueFor(const ValueCounts& counts, const ValueKinds& kinds);

}  // namespace stereonav
