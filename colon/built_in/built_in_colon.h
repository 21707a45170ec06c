// A generated colon CT: the scene that needs no files, with polyps whose place and size are known.
#pragma once

#include <cstdint>
#include <vector>

#include "colon/centreline/centreline.h"
#include "engine/base/progress.h"
#include "engine/volume/volume.h"

namespace stereonav {

enum class PolypShape { Pedunculated, Sessile, Flat };

struct Polyp {
    glm::dvec3 position{0.0};  // world, metres: the middle of its head
    double diameter = 0;       // metres
    PolypShape shape = PolypShape::Sessile;
    double along = 0;  // metres along the axis from the rectum
};

struct BuiltInColon {
    GreyVolume grey;            // HU, with tagged fluid, scanner blur and noise
    std::vector<Polyp> polyps;  // ordered along the axis
    Centreline axis;            // the winding line it was built around, with radii
};

struct BuiltInColonSetting {
    std::uint64_t seed = 1;
    glm::ivec3 size{512, 512, 411};  // voxels
    // The same colon on another day: its loops lie elsewhere by up to `bend`, 0 to 0.03, and its radii are
    // multiplied by `inflation`, 0.7 to 1.4. Folds and polyps stay at their places of the line.
    double bend = 0, inflation = 1;  // metres; factor
};

// Makes the colon of a setting: the same for the same setting, on any number of threads. Made anew each time:
// what is found in it is what the cache keeps. Throws Error on a size it can not show, Cancelled.
BuiltInColon builtInColon(const BuiltInColonSetting& setting, Progress& progress);

}  // namespace stereonav
