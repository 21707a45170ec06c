// One animation channel of a glTF file: keyframes of a translation, rotation or scale, checked.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "engine/gltf/gltf_file.h"

namespace stereonav {

// Interpolation between keyframes, as in glTF.
enum class Interpolation { Linear, Step, CubicSpline };

// The values of one channel over time.
struct PathTrack {
    Interpolation interpolation = Interpolation::Linear;
    bool isRotation = false;
    std::vector<double> times;       // seconds, strictly increasing
    std::vector<glm::dvec4> values;  // one for each time, xyzw; CubicSpline: in-tangent, value, out-tangent

    // Returns the value at a time (seconds), clamped to the ends. left: at a keyframe, the limit from earlier
    // times.
    glm::dvec4 at(double time, bool left) const;
};

// Reads an animation's channel. Throws Error naming animation, channel and keyframe.
PathTrack readPathTrack(const GltfFile& file, int animation, int channel);

}  // namespace stereonav
