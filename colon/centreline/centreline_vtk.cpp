// Centrelines as legacy VTK poly data in ASCII: one polyline a segment, radii as point data, the segments'
// numbers as cell data ("VTK File Formats" in the VTK User's Guide). The title says SPACE=LPS, which 3D
// Slicer looks for.
#include <fmt/format.h>

#include "colon/centreline/centreline_formats.h"

namespace stereonav {
std::string vtkText(const Centreline& line) {
    const std::vector<std::size_t> starts = segmentStarts(line);
    const std::size_t points = line.points.size(), lines = starts.size() - 1;
    std::string text =
        "# vtk DataFile Version 3.0\nstereonav centreline in millimetres, SPACE=LPS\nASCII\nDATASET "
        "POLYDATA\n";
    text += fmt::format("POINTS {} double\n", points);
    for (const CentrelinePoint& p : line.points)
        text += fmt::format("{:.12g} {:.12g} {:.12g}\n", p.position.x * 1e3, p.position.y * 1e3,
                            p.position.z * 1e3);
    text += fmt::format("LINES {} {}\n", lines, points + lines);
    for (std::size_t k = 0; k < lines; ++k) {
        text += fmt::format("{}", starts[k + 1] - starts[k]);
        for (std::size_t n = starts[k]; n < starts[k + 1]; ++n) text += fmt::format(" {}", n);
        text += "\n";
    }
    text += fmt::format("CELL_DATA {}\nSCALARS {} int 1\nLOOKUP_TABLE default\n", lines, kSegmentArray);
    for (std::size_t k = 0; k < lines; ++k) text += fmt::format("{}\n", line.points[starts[k]].segment);
    text += fmt::format("POINT_DATA {}\nSCALARS {} double 1\nLOOKUP_TABLE default\n", points, kRadiusArray);
    for (const CentrelinePoint& p : line.points) text += fmt::format("{:.12g}\n", p.radius * 1e3);
    return text;
}

}  // namespace stereonav
