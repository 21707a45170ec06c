// Lengths for people.
#pragma once

#include <string>

namespace stereonav {

// Returns metres in the unit that suits the size: "1.3 mm", "20.0 m", "1.25 km".
std::string lengthText(double metres);

}  // namespace stereonav
