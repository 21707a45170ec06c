#include "app/output/profile_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/nice_step.h"
#include "engine/metrics/svg_chart.h"

namespace stereonav {
namespace {

constexpr double kWidth = 1000, kHeight = 320, kLeft = 70, kRight = 20, kTop = 34, kBottom = 44;  // pixels

struct ProfileFrame {
    double length, low, high, unit;

    double x(double distance) const { return kLeft + distance / length * (kWidth - kLeft - kRight); }
    double y(double height) const {
        return kHeight - kBottom - (height - low) / (high - low) * (kHeight - kTop - kBottom);
    }
};

ProfileFrame frameOf(const std::vector<LinePoint>& points) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const LinePoint& point : points)
        if (std::isfinite(point.height))
            low = std::min(low, point.height), high = std::max(high, point.height);
    if (!(low <= high)) low = high = 0;
    const double room = std::max(0.05 * (high - low), 0.5);  // level ground gets a metre
    const double length = std::max(points.back().distance, 1e-9);
    return {length, low - room, high + room, length >= 2000 ? 1000.0 : 1.0};
}

std::string gridLines(const ProfileFrame& frame) {
    std::string text;
    const double stepY = niceStep(frame.high - frame.low);
    for (double h = std::ceil(frame.low / stepY) * stepY; h <= frame.high; h += stepY)
        text += fmt::format(
            "<path d='M{:.1f} {:.1f}H{:.1f}' class='grid'/><text x='{:.1f}' y='{:.1f}' "
            "text-anchor='end'>{:.6g}</text>\n",
            kLeft, frame.y(h), kWidth - kRight, kLeft - 6, frame.y(h) + 4, h);
    const double stepX = niceStep(0.6 * frame.length);
    for (int k = 0; k * stepX <= frame.length; ++k)
        text += fmt::format(
            "<path d='M{:.1f} {:.1f}V{:.1f}' class='grid'/><text x='{:.1f}' y='{:.1f}' "
            "text-anchor='middle'>{:.6g}</text>\n",
            frame.x(k * stepX), kTop, kHeight - kBottom, frame.x(k * stepX), kHeight - kBottom + 16,
            k * stepX / frame.unit);
    return text;
}

// Returns the curve, interrupted at holes.
std::string curve(const ProfileFrame& frame, const std::vector<LinePoint>& points) {
    std::string path;
    bool open = true;
    for (const LinePoint& point : points) {
        if (!std::isfinite(point.height)) {
            open = true;
            continue;
        }
        path +=
            fmt::format("{}{:.2f} {:.2f}", open ? "M" : "L", frame.x(point.distance), frame.y(point.height));
        open = false;
    }
    return "<path d='" + path + "' class='line'/>\n";
}

}  // namespace

std::string profileChart(const std::vector<LinePoint>& points, const std::string& title) {
    const ProfileFrame frame = frameOf(points);
    return fmt::format(
               "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:g} {1:g}' width='{0:g}' "
               "height='{1:g}'>\n"
               "<style>text{{font:12px sans-serif;fill:#333}} .grid{{stroke:#ddd;fill:none}} "
               ".line{{stroke:#07c;stroke-width:1.5;fill:none}}</style>\n"
               "<rect width='{0:g}' height='{1:g}' fill='#fff'/>\n<text x='{2:g}' y='20'>{3}</text>\n",
               kWidth, kHeight, kLeft, escapedXml(title)) +
           gridLines(frame) + curve(frame, points) +
           fmt::format(
               "<text x='{:g}' y='{:g}' text-anchor='middle'>distance over the plan, {}</text>\n"
               "<text x='14' y='{:g}' transform='rotate(-90 14 {:g})' text-anchor='middle'>height, m</text>\n"
               "</svg>\n",
               0.5 * (kLeft + kWidth - kRight), kHeight - 8, frame.unit == 1 ? "m" : "km", 0.5 * kHeight,
               0.5 * kHeight);
}

}  // namespace stereonav
