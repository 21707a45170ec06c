// Centrelines as VTK's XML poly data in ASCII, the form that the vascular modelling toolkit reads:
// one piece, one polyline a segment, radii as point data, the segments' numbers as cell data.
#include <fmt/format.h>

#include "colon/centreline/centreline_formats.h"

namespace stereonav {
namespace {

void appendArray(std::string& text, const std::string& type, const std::string& name, int components,
                 const std::string& values) {
    text += fmt::format(
        "        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}"
        "        </DataArray>\n",
        type, name, components, values);
}

}  // namespace

std::string vtpText(const Centreline& line) {
    const std::vector<std::size_t> starts = segmentStarts(line);
    std::string points, radii, segments, connectivity, offsets;
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const CentrelinePoint& p = line.points[n];
        points += fmt::format("{:.12g} {:.12g} {:.12g}\n", p.position.x * 1e3, p.position.y * 1e3,
                              p.position.z * 1e3);
        radii += fmt::format("{:.12g}\n", p.radius * 1e3);
        connectivity += fmt::format("{}\n", n);
    }
    for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
        segments += fmt::format("{}\n", line.points[starts[k]].segment);
        offsets += fmt::format("{}\n", starts[k + 1]);
    }
    std::string text =
        "<?xml version=\"1.0\"?>\n<!-- stereonav centreline in millimetres, SPACE=LPS -->\n"
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <PolyData>\n";
    text += fmt::format(
        "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n      <PointData Scalars=\"{}\">\n",
        line.points.size(), starts.size() - 1, kRadiusArray);
    appendArray(text, "Float64", kRadiusArray, 1, radii);
    text += "      </PointData>\n      <CellData>\n";
    appendArray(text, "Int32", kSegmentArray, 1, segments);
    text += "      </CellData>\n      <Points>\n";
    appendArray(text, "Float64", "Points", 3, points);
    text += "      </Points>\n      <Lines>\n";
    appendArray(text, "Int64", "connectivity", 1, connectivity);
    appendArray(text, "Int64", "offsets", 1, offsets);
    return text + "      </Lines>\n    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

}  // namespace stereonav
