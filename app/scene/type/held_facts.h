// Facts on the memory that a scene holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/facts.h"

namespace stereonav {

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
