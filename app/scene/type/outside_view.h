// Views and flight for scenes that are seen from outside and may be entered: media and meshes.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "engine/camera/default_eyes.h"
#include "engine/camera/first_view.h"
#include "engine/nav/flight.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Sets lens, eyes, start and flight of `scene`: a ball around the box from low to high (world, metres) fills
// the picture, seen northwards from a little above, and the flight goes around it once. flight: its name in
// messages, "the flight around the medium".
void seeFromOutside(const glm::dvec3& low, const glm::dvec3& high, SeenAs seen, const std::string& flight,
                    Scene& scene);

// Sets the same by what is seen of an object, of which these are samples (engine/camera/first_view.h).
// Returns the turn of the start, radians clockwise from north; nothing, and sets nothing, where no view is
// found.
std::optional<double> seeFromBestSide(const std::vector<SurfaceSample>& samples, const SceneOptions& options,
                                      SeenAs seen, const std::string& flight, Scene& scene);

// Returns a flight without ground or walls. extent: metres, crossed in ten seconds at normal speed, > 0.
std::unique_ptr<Flight> freeFlight(const Pose& home, double extent);

}  // namespace stereonav
