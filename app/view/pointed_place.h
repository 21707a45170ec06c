// What there is to say of the place that the pointer is over.
#pragma once

#include <glm/vec3.hpp>

#include "engine/scene/facts.h"
#include "engine/scene/scene.h"
#include "engine/scene/slices.h"

namespace stereonav {

// What the scene says of it (PlaceReader), the study's value there where its slices have been read (else
// null), and how far it is. world, eye: metres.
Facts factsOfPlace(const Scene& scene, const SliceStudy* study, const glm::dvec3& world,
                   const glm::dvec3& eye);

}  // namespace stereonav
