// A capability (capabilities.h): the values of a volume, and what they are shown as, for who edits that.
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

// Values of a study that was read once, however it is seen.
struct StudyValues {
    std::string unit;  // "HU", or "" where it is not known
    ValueSpan range;
    // Counts the values of what may be shown; holds what it counts. Any thread; throws Cancelled.
    std::function<ValueCounts(Progress&)> count;
};

// The surface that options gave when the study was read.
struct BegunSurface {
    std::optional<double> isovalue;  // none: it can not be moved
    bool isovalueChosen = false;     // no option says it
    bool translucent = false;
    std::string transfer;  // a file, a name or a curve; "": by `opacity`
    double opacity = 0;    // a millimetre: of a wall that is translucent without `transfer`
};

struct ShownValues {
    std::shared_ptr<const StudyValues> values;  // the same for all scenes of one study
    TransferFunction function;                  // empty: the opaque surface alone
    BegunSurface begun;
};

}  // namespace stereonav
