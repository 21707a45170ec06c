// Facts of scenes by their content: the parts of Scene::describe().
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/facts.h"
#include "engine/scene/scene.h"

namespace stereonav {

Facts factsOfMesh(const Scene& scene);     // scene has to offer const MeshRenderer
Facts factsOfTerrain(const Scene& scene);  // scene has to offer const TerrainScene
Facts factsOfVolume(const Scene& scene);   // scene has to offer const ColonScene
// Returns the facts of a scene that offers MediumScene. Makes a frame at the start pose, for the sweep's
// memory.
Facts factsOfMedium(const Scene& scene);

// Returns "curvature" for ground over a round Earth: its drop, the Earth's radius and the refraction. Empty
// for other scenes.
std::optional<Fact> factOfCurvature(const Scene& scene);

// A part of the scene and its memory; parts that the scene does not have are left out.
struct Held {
    std::string what;
    std::size_t bytes = 0;
};
// Adds "bytes", the sum, and "held", the parts, for JSON only. Returns the same as text, which follows other
// facts: "32.1 MB: values 20.0, cells 12.1".
std::string addHeld(Facts& facts, const std::vector<Held>& held);

// Returns a count as a number for facts.
inline std::int64_t countOf(std::size_t count) {
    return static_cast<std::int64_t>(count);
}

}  // namespace stereonav
