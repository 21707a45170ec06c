// Meshes placed in a terrain (glTF), cast with Embree after the ground: a landmark is seen where it is nearer
// than the ground. Both eyes, hole filling and region V use the same set.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/packed_color.h"
#include "terrain/ground/heightfield.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

class LandmarkSet {
public:
    // Reads and places the meshes and builds their tree. Throws Error with file and place.
    LandmarkSet(const std::vector<LandmarkFile>& files, const Heightfield& ground, const TerrainLook& look);
    ~LandmarkSet();

    // Casts `count` rays from view.eye: where a mesh is hit in front of viewDepth[k], metres, replaces
    // viewDepth[k] and color[k]. direction: unit length along the view axis (rayDirection()). A negative
    // viewDepth[k] marks a lane to leave alone. throughFog: colours as the eye sees them; else the meshes'
    // own. Safe from several threads.
    void cast(const EyeView& view, int count, const glm::dvec3* direction, float* viewDepth,
              PackedColor* color, bool throughFog = true) const;

    // Changes the light and fog to those of a look. No cast() may run meanwhile.
    void setLook(const TerrainLook& look);

    // World bounding box of everything, metres.
    glm::dvec3 boundsMin() const;
    glm::dvec3 boundsMax() const;
    std::size_t triangleCount() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
