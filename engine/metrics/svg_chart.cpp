#include "engine/metrics/svg_chart.h"

#include <fmt/format.h>

#include "engine/text/printable.h"

namespace stereonav {
namespace {

constexpr const char* kAloneStyle =
    "<style>text{font-family:sans-serif;fill:#333} .grid{stroke:#ddd} .frame{stroke:#ddd;fill:none} "
    ".curve{stroke:#07c;stroke-width:1.5;fill:none}</style>\n"
    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";

std::string elementOf(const ChartMark& mark) {
    const glm::dvec2 at = mark.places.front();
    if (mark.radius > 0) {
        const std::string title = mark.words.empty() ? "" : "<title>" + escapedXml(mark.words) + "</title>";
        return fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\">{}</circle>\n",
                           mark.style, at.x, at.y, mark.radius, title);
    }
    if (mark.places.size() == 1)
        return fmt::format(
            "<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" "
            "text-anchor=\"{}\"{}>{}</text>\n",
            mark.style, at.x, at.y, kChartFont, mark.anchor,
            mark.upright ? fmt::format(" transform=\"rotate(-90 {:g} {:.1f})\"", at.x, at.y) : "",
            escapedXml(mark.words));
    std::string path;
    for (const glm::dvec2& corner : mark.places)
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", corner.x, corner.y);
    return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", mark.style, path);
}

}  // namespace

std::string svgOf(const Chart& chart, bool alone) {
    const ChartDrawing drawing = drawingOf(chart);
    std::string svg = fmt::format(
        "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
        "role=\"img\"{2}>\n<title>{3}</title>\n{4}",
        drawing.width, drawing.height,
        alone ? fmt::format(" width=\"{:g}\" height=\"{:g}\"", drawing.width, drawing.height) : "",
        escapedXml(chart.title), alone ? kAloneStyle : "");
    for (const ChartMark& mark : drawing.marks) svg += elementOf(mark);
    return svg + "</svg>" + (alone ? "\n" : "");
}

std::string escapedXml(std::string_view text) {
    std::string escaped;
    for (const char c : printableLines(text)) switch (c) {
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '&':
                escaped += "&amp;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\'':
                escaped += "&#39;";
                break;
            default:
                escaped += c;
        }
    return escaped;
}

}  // namespace stereonav
