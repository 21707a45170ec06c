// A capability (capabilities.h): the values of a volume and their display, for editors of that.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/progress.h"
#include "engine/volume/transfer_function.h"
#include "engine/volume/value_counts.h"
#include "engine/volume/value_range.h"

namespace stereonav {

// Values of a study, which are read once and shared by all scenes made of it.
struct StudyValues {
    std::string unit;  // "HU"; "" where it is unknown
    ValueSpan range;
    // Counts the values that may be shown; holds the data that it counts. Any thread; throws Cancelled.
    std::function<ValueCounts(Progress&)> count;
};

// The surface according to the options, when the study was read.
struct BegunSurface {
    std::optional<double> isovalue;  // empty: the surface can not be moved
    bool isovalueChosen = false;     // no option sets it
    bool translucent = false;
    std::string transfer;  // a file, a name or a curve; "": by `opacity`
    double opacity = 0;    // per millimetre: of a translucent wall without `transfer`
};

struct ShownValues {
    std::shared_ptr<const StudyValues> values;  // the same for all scenes of one study
    TransferFunction function;                  // empty: only the opaque surface
    BegunSurface begun;
};

}  // namespace stereonav
