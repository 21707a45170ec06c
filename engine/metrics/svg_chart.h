// Charts as SVG.
#pragma once

#include <string>
#include <string_view>

#include "engine/metrics/chart_drawing.h"

namespace stereonav {

// Returns an <svg> element. Its colours come from the page's style sheet, whose classes are the styles of the
// marks, so that one drawing serves light and dark pages and paper. alone: returns a whole file with its own
// size and colours on white instead.
std::string svgOf(const Chart& chart, bool alone = false);

// Returns printable text (engine/text/printable.h), with <, >, & and quotes made harmless in XML and HTML.
std::string escapedXml(std::string_view text);

}  // namespace stereonav
