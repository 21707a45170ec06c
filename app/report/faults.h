// Deliberate faults, to try whether comparing two reports catches them. Only a build with
// -DSTEREONAV_FAULTS=ON has any (faults_on.cpp); every other one gives null (faults_off.cpp).
#pragma once

#include <memory>

#include "engine/render/eye_renderer.h"

namespace stereonav {

// The renderer, which must outlive it, with faults; null where there are none.
std::unique_ptr<EyeRenderer> withFaults(const EyeRenderer& renderer);

}  // namespace stereonav
