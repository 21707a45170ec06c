// The colon that a command's scene names, for instruments that measure on it.
#pragma once

#include <memory>
#include <string>

#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "colon/wall/line_of_sight.h"
#include "colon/wall/wall_mesh.h"
#include "engine/base/progress.h"
#include "engine/scene/facts.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Returns the colon of a scene. Throws Error that names the scene where no colon was found.
const ColonScene& colonOf(const Scene& scene, const SceneOptions& options);

// Returns a place in millimetres with one decimal: "12.3, -4.0, 100.7".
std::string placeText(const glm::dvec3& world);
// Returns a place in millimetres for documents.
FactNumbers placeNumbers(const glm::dvec3& world);

// Note on results that could be taken for those of a medical device.
constexpr const char* kNoMedicalDevice = "stereonav is not a medical device";

}  // namespace stereonav
