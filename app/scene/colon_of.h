// The colon that a command's scene names, and what instruments measure on it.
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

// Throws Error unless the name can be that of a colon: before anything is read.
void expectColonName(const std::string& scene);

// The colon in it. Throws Error, naming it, where none was found.
const ColonScene& colonOf(const Scene& scene, const SceneOptions& options);

// Millimetres with a comma between them, a tenth each: "12.3, -4.0, 100.7".
std::string placeText(const glm::dvec3& world);
// The same for documents: millimetres.
FactNumbers placeNumbers(const glm::dvec3& world);

// What is said of results that could be taken for a physician's.
constexpr const char* kNoMedicalDevice = "stereonav is not a medical device";

}  // namespace stereonav
