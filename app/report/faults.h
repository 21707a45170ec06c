// Deliberate faults, to test whether the comparison of two reports finds them. Only builds with
// -DSTEREONAV_FAULTS=ON have any (faults_on.cpp); others return null (faults_off.cpp).
#pragma once

#include <memory>

#include "engine/render/eye_renderer.h"

namespace stereonav {

// Returns the renderer with faults, which it must outlive; null where there are none.
std::unique_ptr<EyeRenderer> withFaults(const EyeRenderer& renderer);

}  // namespace stereonav
