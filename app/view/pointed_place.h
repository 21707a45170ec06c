// Facts of the place under the pointer.
#pragma once

#include <glm/vec3.hpp>

#include "engine/scene/facts.h"
#include "engine/scene/scene.h"
#include "engine/scene/slices.h"

namespace stereonav {

// Returns the scene's facts (PlaceReader), the study's value where its slices have been read (else null), and
// the distance. world, eye: metres.
Facts factsOfPlace(const Scene& scene, const SliceStudy* study, const glm::dvec3& world,
                   const glm::dvec3& eye);

}  // namespace stereonav
