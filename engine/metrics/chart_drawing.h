// Charts, and the marks that they are drawn with: points with the spread of their repeats, labelled where
// there is room, and a line through the points of the Pareto front.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/metrics/chart_scale.h"
#include "engine/metrics/spread.h"

namespace stereonav {

struct ChartPoint {
    std::string name;
    Spread x, y;
    bool isDefault = false;  // whether it is the program's default: drawn with a ring
};

struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points;
    bool joined = false;                 // by a line, in their order
    std::vector<glm::dvec2> curve = {};  // a line without points, interrupted where y is not finite
};

// Pixels of a drawing, which scales with its page.
constexpr double kChartWidth = 420, kChartHeight = 320, kChartFont = 11;

struct Chart {
    std::string title, xLabel, yLabel;
    ChartScale::Kind xKind = ChartScale::Kind::Automatic, yKind = ChartScale::Kind::Automatic;
    std::vector<ChartSeries> series = {};
    bool front = true;           // marks the Pareto front; smaller is better on both axes
    bool titled = false;         // the title is drawn; otherwise it is only for screen readers
    double width = kChartWidth;  // pixels
};

// A line, a dot or words.
struct ChartMark {
    std::string style;  // ink, grid, frame, spread, front, curve, join s0 to s5, default, dot s0 to s5 (best)
    // Corners of a line; a single place: middle of a dot, or position of words.
    std::vector<glm::dvec2> places;
    std::string words = {};         // for a dot: its meaning
    const char* anchor = "middle";  // part of the words that stands at the place: start, middle or end
    bool upright = false;           // words read upwards
    double radius = 0;              // pixels; above 0: a dot
};

struct ChartDrawing {
    double width = 0, height = 0;  // pixels
    std::vector<ChartMark> marks;
};

// Returns the chart's marks. Points with a value that is not finite, or not measured, are left out. On a
// logarithmic axis zeros lie on a line of their own, "0", below the rest.
ChartDrawing drawingOf(const Chart& chart);

// Returns the charts in a row, with the caption and an explanation of their fronts below.
ChartDrawing sideBySide(const std::vector<Chart>& charts, const std::string& caption);

// A rectangle for a label, for tests and drawingOf().
struct LabelBox {
    double x = 0, y = 0, width = 0, height = 0;  // pixels, y downwards
    bool overlaps(const LabelBox& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
               other.y < y + height;
    }
};
struct LabelWish {
    std::string text;
    double x = 0, y = 0;  // place of the point, pixels
};
// Returns for each wish, in their order, a box near its point that is inside the frame and overlaps no point
// and no earlier box, and if possible nothing that is to be avoided; width 0 where there is no such box.
std::vector<LabelBox> placeLabels(const std::vector<LabelWish>& wishes, const LabelBox& frame,
                                  const std::vector<LabelBox>& avoided = {});

}  // namespace stereonav
