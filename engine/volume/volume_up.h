// Which way up a volume is: files without directions may lie on a side or stand on their heads.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/volume/volume.h"

namespace stereonav {

// An axis of the world as a file has it, either way.
struct UpAxis {
    int axis = 2;  // x, y, z
    bool negative = false;
    bool operator==(const UpAxis&) const = default;
};

// Returns the axis of "x", "-x", "y", "-y", "z" or "-z"; else nothing.
std::optional<UpAxis> upAxisFromText(std::string_view text);
std::string nameOf(const UpAxis& up);

// Returns the rotation by quarter turns that brings this axis up, to +z. Seen to the north, the picture
// itself turns where that will do: -z is upside down, not back to front.
glm::dmat3 turnThatPutsUp(const UpAxis& up);

// Turns the places of a volume about the world's origin; its values stay the same.
void turnUp(VolumeFrame& frame, const UpAxis& up);

}  // namespace stereonav
