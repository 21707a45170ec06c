// Deliberate faults, to try whether comparing two reports catches them. Only a build with
// -DSTEREONAV_FAULTS=ON has any (faults_on.cpp); every other one gives the renderer back as it is
// (faults_off.cpp).
#pragma once

#include <memory>

#include "engine/render/eye_renderer.h"

namespace stereonav {

std::unique_ptr<EyeRenderer> withFaults(std::unique_ptr<EyeRenderer> renderer);

}  // namespace stereonav
