// A unit normal in 32 bits, for EyeImage::normal: octahedral, 16 bits an axis, x in the low half.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace stereonav {

std::uint32_t packNormal(const glm::dvec3& unit);
glm::dvec3 unpackNormal(std::uint32_t packed);

}  // namespace stereonav
