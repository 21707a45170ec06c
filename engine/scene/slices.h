// The grey values behind a scene, for pictures of its slices.
#pragma once

#include <memory>
#include <vector>

#include "engine/base/progress.h"
#include "engine/volume/volume.h"

namespace stereonav {

struct SliceStudy {
    GreyVolume grey;
    bool ofMask = false;                            // it says what is lumen, and nothing of values
    double windowWidth = 1500, windowLevel = -200;  // values shown from black to white, and their middle
};

// A capability (capabilities.h): it was made from slices.
class SliceSource {
public:
    virtual ~SliceSource() = default;
    // Reads them again; takes seconds, on any thread. Throws Error, Cancelled.
    virtual std::shared_ptr<const SliceStudy> readSlices(Progress& progress) const = 0;
    // To be outlined in them; null where there is none.
    virtual const MaskVolume* lumen() const = 0;
    // World places that it was found from.
    virtual const std::vector<glm::dvec3>& seeds() const = 0;
};

}  // namespace stereonav
