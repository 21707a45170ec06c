// What scenes are made of, as facts: what Scene::describe() is put together from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/facts.h"
#include "engine/scene/scene.h"

namespace stereonav {

Facts factsOfMesh(const Scene& scene);     // of one that offers const MeshRenderer
Facts factsOfTerrain(const Scene& scene);  // of one that offers const TerrainScene
Facts factsOfVolume(const Scene& scene);   // of one that offers const ColonScene
// Of one that offers MediumScene: makes a frame at the start pose, for what the sweep then holds.
Facts factsOfMedium(const Scene& scene);

// "curvature", of ground over a round Earth: how it sinks, the Earth's radius and the refraction. None of
// other scenes.
std::optional<Fact> factOfCurvature(const Scene& scene);

// What holds how much memory; nothing that the scene does not have is named.
struct Held {
    std::string what;
    std::size_t bytes = 0;
};
// Adds "bytes", their sum, and "held", the parts, for JSON alone. Returns the same for people, who read it
// after other facts: "32.1 MB: values 20.0, cells 12.1".
std::string addHeld(Facts& facts, const std::vector<Held>& held);

// A count as facts have it.
inline std::int64_t countOf(std::size_t count) {
    return static_cast<std::int64_t>(count);
}

}  // namespace stereonav
