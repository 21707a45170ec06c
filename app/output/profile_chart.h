// A profile as a drawing of its own: height over distance, as SVG.
#pragma once

#include <string>
#include <vector>

#include "terrain/survey/ground_line.h"

namespace stereonav {

// points: two or more; where a height is not known the line is open.
std::string profileChart(const std::vector<LinePoint>& points, const std::string& title);

}  // namespace stereonav
