// A profile as a drawing in SVG: height over distance.
#pragma once

#include <string>
#include <vector>

#include "terrain/survey/ground_line.h"

namespace stereonav {

// points: two or more; the curve is interrupted where a height is not known.
std::string profileChart(const std::vector<LinePoint>& points, const std::string& title);

}  // namespace stereonav
