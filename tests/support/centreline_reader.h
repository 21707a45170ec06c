// Centrelines read from their files by plain search, without code of the program.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "colon/centreline/centreline.h"
#include "engine/base/file.h"

namespace stereonav::test {

// Returns the numbers that follow a mark's line, up to the first text that is no number.
inline std::vector<double> numbersBehind(const std::string& text, const std::string& mark) {
    std::vector<double> values;
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) return values;
    std::istringstream in(text.substr(text.find('\n', at)));
    for (double value; in >> value;) values.push_back(value);
    return values;
}

// Returns the numbers between the tags of the array with this name.
inline std::vector<double> arrayOf(const std::string& xml, const std::string& name) {
    return numbersBehind(xml, "Name=\"" + name + "\"");
}

// Reads a file whose lines go through all points in order.
inline Centreline readCentreline(const std::filesystem::path& file) {
    const std::string text = readTextFile(file), extension = file.extension().string();
    const std::string radius = "MaximumInscribedSphereRadius";
    Centreline line;
    if (extension == ".txt") {
        const std::vector<double> all = numbersBehind(text, "#");
        for (std::size_t n = 0; n + 4 < all.size(); n += 5)
            line.points.push_back({glm::dvec3(all[n], all[n + 1], all[n + 2]) * 1e-3, all[n + 3] * 1e-3,
                                   static_cast<int>(all[n + 4])});
        return line;
    }
    const bool legacy = extension == ".vtk";
    const std::vector<double> points = legacy ? numbersBehind(text, "POINTS ") : arrayOf(text, "Points"),
                              radii = legacy ? numbersBehind(text.substr(text.find(radius)), "LOOKUP_TABLE")
                                             : arrayOf(text, radius),
                              segments =
                                  legacy ? numbersBehind(text.substr(text.find("Segment")), "LOOKUP_TABLE")
                                         : arrayOf(text, "Segment");
    std::vector<double> ends = legacy ? std::vector<double>() : arrayOf(text, "offsets");
    const std::vector<double> rows = legacy ? numbersBehind(text, "LINES ") : std::vector<double>();
    for (std::size_t n = 0; n < rows.size(); n += static_cast<std::size_t>(rows[n]) + 1)
        ends.push_back((ends.empty() ? 0 : ends.back()) + rows[n]);
    std::size_t segment = 0;
    for (std::size_t n = 0; n < radii.size(); ++n) {
        while (static_cast<double>(n) >= ends.at(segment)) ++segment;
        line.points.push_back(
            {glm::dvec3(points.at(3 * n), points.at(3 * n + 1), points.at(3 * n + 2)) * 1e-3, radii[n] * 1e-3,
             static_cast<int>(segments.at(segment))});
    }
    return line;
}

}  // namespace stereonav::test
