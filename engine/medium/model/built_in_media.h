// Media that the program generates, identical on every machine.
#pragma once

#include <memory>

#include "engine/medium/model/medium.h"

namespace stereonav {

// Returns a cloud: 64^3 values 0..1000, blended ellipsoids, 2 km wide (Kniss et al. 2003, fig. 10); noise
// adds the detail.
std::shared_ptr<GreyVolume> makeCloudField();
Perturbation cloudPerturbation();

// Returns a block of wax with a hollow for the wick, 96^3, 80 mm (fig. 9): values 0..1000.
std::shared_ptr<GreyVolume> makeWaxField();
// Returns a sitting rabbit of wax, 128^3, 80 mm, 70 mm high: values 0..1000. Its ears are thin: light shines
// through.
std::shared_ptr<GreyVolume> makeWaxRabbit();

}  // namespace stereonav
