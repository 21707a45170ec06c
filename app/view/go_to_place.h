// Where a typed place lies in the scene that is shown, and the flight there.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "app/view/session.h"

namespace stereonav {

struct FoundPlace {
    std::string words;                // "34.35000 N 118.10000 W, 1203 m high"
    std::optional<glm::dvec3> world;  // the place to look at, metres
    std::optional<double> along;      // metres along the scene's line, in place of `world`
    std::string problem;              // one line, with what is expected; "": it was found
};

// Returns where the text lies in the scene; empty where it is nothing that people write for a place. The
// first way to read it that lies in the scene counts.
std::optional<FoundPlace> findPlace(const Scene& scene, const std::string& text);

// Returns what places this scene takes, with examples; "" where it takes none.
std::string expectedPlaces(const Scene& scene);

// Returns the pose that looks at a place from the side of `now`: over ground as high as now, within limits of
// the ground's size, and so steep that nothing stands between.
Pose viewOfPlace(const Scene& scene, const glm::dvec3& place, const Pose& now);

// Flies to a place that was found: along the scene's line, or to where it is seen.
void goToPlace(ViewSession& session, const FoundPlace& place);

}  // namespace stereonav
