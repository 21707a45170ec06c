// Centrelines as legacy VTK poly data in ASCII: one polyline a segment, radii as point data, the segments'
// numbers as cell data ("VTK File Formats" in the VTK User's Guide). The title says SPACE=LPS, which 3D
// Slicer looks for.
#include <fmt/format.h>

#include "colon/centreline/centreline_formats.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

void readPoints(NumberText& words, PolyLines& poly) {
    const std::size_t count = words.count("points");
    words.word();  // the type of number
    const std::string what = "a coordinate";
    for (std::size_t n = 0; n < 3 * count; ++n) poly.coordinates.push_back(words.number(what));
}

void readLines(NumberText& words, PolyLines& poly) {
    const std::size_t lines = words.count("lines"), total = words.count("numbers of all lines");
    std::size_t read = 0;
    for (std::size_t k = 0; k < lines; ++k) {
        const std::size_t count = words.count("points of a line");
        poly.lines.emplace_back();
        for (std::size_t n = 0; n < count; ++n) {
            const double point = words.number("a point's number");
            if (!(point >= 0 && point < 1e15)) words.fail(fmt::format("there is no point {:g}", point));
            poly.lines.back().push_back(static_cast<std::size_t>(point));
        }
        read += count + 1;
    }
    if (read != total) words.fail(fmt::format("expected {} numbers for the lines, got {}", total, read));
}

void readArray(NumberText& words, std::string_view name, std::size_t count, PolyLines& poly) {
    const std::string what(name.substr(0, 40));
    std::vector<double> values;
    for (std::size_t n = 0; n < count; ++n) values.push_back(words.number(what));
    if (name == kRadiusArray) poly.radii = std::move(values);
    if (name == kSegmentArray) poly.segments = std::move(values);
}

// SCALARS name type [components], LOOKUP_TABLE name, values.
void readScalars(NumberText& words, std::size_t count, PolyLines& poly) {
    const std::string_view name = words.word();
    words.word();
    std::string_view next = words.word();
    if (next == "1") next = words.word();
    if (next != "LOOKUP_TABLE")
        words.fail(fmt::format("expected one number a point and a LOOKUP_TABLE, got \"{}\"", next));
    words.word();
    readArray(words, name, count, poly);
}

// FIELD name arrays, then for each: name components tuples type, values.
void readField(NumberText& words, PolyLines& poly) {
    words.word();
    const std::size_t arrays = words.count("arrays");
    for (std::size_t k = 0; k < arrays; ++k) {
        const std::string_view name = words.word();
        const std::size_t components = words.count("numbers a point"), tuples = words.count("points");
        words.word();
        readArray(words, name, components * tuples, poly);
    }
}

}  // namespace

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

Centreline centrelineFromVtk(const std::string& text, const std::string& file) {
    // Magic and title are lines of their own.
    const std::size_t title = text.find('\n'),
                      body = title == std::string::npos ? title : text.find('\n', title + 1);
    if (text.rfind("# vtk DataFile", 0) != 0 || body == std::string::npos)
        throw Error(file, "1", "expected \"# vtk DataFile Version\"",
                    "give a centreline as legacy VTK poly data");
    NumberText words(file, std::string_view(text).substr(body), 2);
    if (words.word() != "ASCII") words.fail("expected ASCII");
    if (words.word() != "DATASET" || words.word() != "POLYDATA") words.fail("expected DATASET POLYDATA");
    PolyLines poly;
    std::size_t count = 0;
    while (!words.atEnd()) {
        const std::string_view key = words.word();
        if (key == "POINTS")
            readPoints(words, poly);
        else if (key == "LINES")
            readLines(words, poly);
        else if (key == "POINT_DATA" || key == "CELL_DATA")
            count = words.count("values");
        else if (key == "SCALARS")
            readScalars(words, count, poly);
        else if (key == "FIELD")
            readField(words, poly);
        else
            words.fail(
                fmt::format("expected POINTS, LINES, POINT_DATA, CELL_DATA, SCALARS or FIELD, got \"{}\"",
                            key.substr(0, 40)));
    }
    if (poly.radii.empty() && !poly.coordinates.empty())
        throw Error(file, "", std::string("expected a point array ") + kRadiusArray + ", found none",
                    "write the centreline with its radii");
    return centrelineFrom(poly, file);
}

}  // namespace stereonav
