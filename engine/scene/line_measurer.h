// Measures a line over a scene's surface, for the window.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/base/progress.h"
#include "engine/scene/facts.h"

namespace stereonav {

struct MeasuredSurface {
    Facts facts;  // each with a label and a text
    // The line on the surface: places in the world, metres; for each its distance along the line in plan, and
    // its height, metres, which may be NaN.
    std::vector<glm::dvec3> places;
    std::vector<glm::dvec2> profile;
};

// A capability (capabilities.h).
class LineMeasurer {
public:
    virtual ~LineMeasurer() = default;
    // Measures a line. places: world, two or more different ones, on or near the surface; closed: the border
    // of an area, three or more. May take seconds; from any thread. Throws Error where nothing can be
    // measured there, Cancelled.
    virtual MeasuredSurface measure(const std::vector<glm::dvec3>& places, bool closed,
                                    Progress& progress) const = 0;
    MeasuredSurface measure(const std::vector<glm::dvec3>& places, bool closed) const {
        Progress progress;
        return measure(places, closed, progress);
    }
    // Returns whether two places at a height in metres above the surface see each other; empty where it is
    // unknown. Throws as measure().
    virtual Facts sight(const glm::dvec3& /*from*/, const glm::dvec3& /*to*/, double /*height*/) const {
        return {};
    }
};

}  // namespace stereonav
