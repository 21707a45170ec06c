// A plot of error against time, drawn with OpenCV: one or more panels side by side, logarithmic in
// error, each point named, the points that no other beats in both marked and joined.
#pragma once

#include <string>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

struct PlotPoint {
    std::string name;
    double time_ms = 0;  // >= 0
    double error = 0;    // > 0; a point with error 0 is drawn on the lower border, marked as exact
};

struct PlotPanel {
    std::string title, timeLabel, errorLabel;
    std::vector<PlotPoint> points;
};

// Returns the indices of the points that no other point beats (smaller or equal in both, smaller in one), by
// rising time.
std::vector<std::size_t> paretoFront(const std::vector<PlotPoint>& points);

// Draws panels: at least one with at least one point each. caption: a line under the panels. 760 x 620 pixels
// a panel. Throws Error.
Plane<PackedColor> drawErrorPlot(const std::vector<PlotPanel>& panels, const std::string& caption);

}  // namespace stereonav
