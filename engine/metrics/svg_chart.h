// Charts as SVG for a page: points with the spread of their repeats, named where there is room, the points
// that none beats joined by a line. Colours come from the page's style sheet (classes ink, grid, front, s0 to
// s5, default), so that one drawing serves light, dark and paper.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/metrics/chart_scale.h"
#include "engine/metrics/spread.h"

namespace stereonav {

struct ChartPoint {
    std::string name;
    Spread x, y;             // values in the units that the axes' labels say
    bool isDefault = false;  // the program's default: drawn with a ring
};

struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points;
    bool joined = false;  // by a line, in their order
};

struct Chart {
    std::string title, xLabel, yLabel;  // the title is for readers of screens
    ChartScale::Kind xKind = ChartScale::Kind::Automatic, yKind = ChartScale::Kind::Automatic;
    std::vector<ChartSeries> series;
    bool front = true;  // less is better in both: mark those that none beats
};

// Pixels of the drawing, which scales with the page.
constexpr double kChartWidth = 420, kChartHeight = 320;

// Returns an <svg> element. Points with a value that is not finite, or not measured, are left out. On a
// logarithmic axis zeros lie on a line of their own, "0", below the rest.
std::string svgOf(const Chart& chart);

// Returns printable text (engine/text/printable.h), with <, >, & and quotes made harmless in XML and HTML.
std::string escapedXml(std::string_view text);

// A rectangle that labels stand in, in pixels, y downwards: for tests, and for svgOf.
struct LabelBox {
    double x = 0, y = 0, width = 0, height = 0;
    bool overlaps(const LabelBox& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
               other.y < y + height;
    }
};
struct LabelWish {
    std::string text;
    double x = 0, y = 0;  // the point's, pixels
};
// Returns for each wish, in their order, a box near its point that is inside the frame and clear of all
// points and boxes before; width 0 where there is no such place.
std::vector<LabelBox> placeLabels(const std::vector<LabelWish>& wishes, const LabelBox& frame);

}  // namespace stereonav
