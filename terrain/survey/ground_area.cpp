#include "terrain/survey/ground_area.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "terrain/survey/ground_line.h"

namespace stereonav {
namespace {

using Corners = std::vector<glm::dvec2>;  // grid

// What lies on one side of a column or row (Sutherland and Hodgman 1974). Of a polygon with dents edges on
// the line are gone over twice, there and back, which cancels in what is summed over it.
Corners clipped(const Corners& corners, int axis, double line, bool above) {
    Corners inside;
    for (std::size_t n = 0; n < corners.size(); ++n) {
        const glm::dvec2 &here = corners[n], &next = corners[(n + 1) % corners.size()];
        const double a = above ? here[axis] - line : line - here[axis];
        const double b = above ? next[axis] - line : line - next[axis];
        if (a >= 0) inside.push_back(here);
        if ((a >= 0) != (b >= 0)) {
            glm::dvec2 cut = here + a / (a - b) * (next - here);
            cut[axis] = line;
            inside.push_back(cut);
        }
    }
    return inside;
}

double crossOf(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// One cell, or what continues the last one.
struct Cell {
    int i, j;
    double a, b, c, twist;
    glm::dvec2 spacing;

    Cell(const Heightfield& ground, int column, int row) : spacing(ground.spacing()) {
        const int x = std::clamp(column, 0, ground.width() - 2), y = std::clamp(row, 0, ground.height() - 2);
        i = x, j = y;
        a = ground.sample(x, y), b = ground.sample(x + 1, y), c = ground.sample(x, y + 1);
        twist = a - b - c + ground.sample(x + 1, y + 1);
    }
    double height(const glm::dvec2& g) const {
        const double u = g.x - i, v = g.y - j;
        return a + (b - a) * u + (c - a) * v + twist * u * v;
    }
    // Area of the surface over one of the plan.
    double stretch(const glm::dvec2& g) const {
        const glm::dvec2 slope = glm::dvec2(b - a + twist * (g.y - j), c - a + twist * (g.x - i)) / spacing;
        return std::sqrt(1 + glm::dot(slope, slope));
    }
};

struct Triangle {
    glm::dvec2 a, b, c;
    double area() const { return 0.5 * crossOf(b - a, c - a); }  // signed, grid units
};

// Seven places, exact for polynomials to the fifth degree (Radon 1948).
double surfaceOver(const Cell& cell, const Triangle& t) {
    const double root = std::sqrt(15.0);
    const glm::dvec2 middle = (t.a + t.b + t.c) / 3.0;
    double sum = 0.225 * cell.stretch(middle);
    for (const auto& [near, weight] :
         {std::pair{(6 - root) / 21, (155 - root) / 1200}, std::pair{(6 + root) / 21, (155 + root) / 1200}})
        for (const glm::dvec2& corner : {t.a, t.b, t.c})
            sum += weight * cell.stretch(near * (t.a + t.b + t.c) + (1 - 3 * near) * corner);
    return sum * t.area();
}

// Over and under a plane, in metres of height times the triangle's area. The middles of the sides are exact
// for the second degree.
glm::dvec2 volumeOver(const Cell& cell, const Triangle& t, double plane, int halvings) {
    const glm::dvec2 ab = 0.5 * (t.a + t.b), bc = 0.5 * (t.b + t.c), ca = 0.5 * (t.c + t.a);
    const double corner[3] = {cell.height(t.a) - plane, cell.height(t.b) - plane, cell.height(t.c) - plane};
    const double middle[3] = {cell.height(ab) - plane, cell.height(bc) - plane, cell.height(ca) - plane};
    const auto [low, high] = std::minmax({corner[0], corner[1], corner[2], middle[0], middle[1], middle[2]});
    if (halvings == 0 || low >= 0 || high <= 0) {
        glm::dvec2 sum(0.0);
        for (const double height : middle)
            sum += low >= 0    ? glm::dvec2(height, 0)
                   : high <= 0 ? glm::dvec2(0, -height)
                               : glm::dvec2(std::max(height, 0.0), std::max(-height, 0.0));
        return sum * (t.area() / 3);
    }
    return volumeOver(cell, {t.a, ab, ca}, plane, halvings - 1) +
           volumeOver(cell, {ab, t.b, bc}, plane, halvings - 1) +
           volumeOver(cell, {ca, bc, t.c}, plane, halvings - 1) +
           volumeOver(cell, {ab, bc, ca}, plane, halvings - 1);
}

void addCell(const Cell& cell, const Corners& part, double plane, AreaMeasure& sum) {
    for (std::size_t n = 2; n < part.size(); ++n) {
        const Triangle triangle{part[0], part[n - 1], part[n]};
        if (triangle.area() == 0) continue;
        sum.plan += triangle.area();
        sum.along += surfaceOver(cell, triangle);
        const glm::dvec2 volume = volumeOver(cell, triangle, plane, kHalvings);
        sum.above += volume.x, sum.below += volume.y;
    }
    for (const glm::dvec2& corner : part) {
        sum.lowest = std::min(sum.lowest, cell.height(corner));
        sum.highest = std::max(sum.highest, cell.height(corner));
    }
}

}  // namespace

AreaMeasure measureArea(const Heightfield& ground, const std::vector<glm::dvec2>& corners, double plane) {
    Corners polygon;
    for (const glm::dvec2& corner : corners) polygon.push_back(ground.gridFromWorld(corner));
    AreaMeasure sum;
    sum.lowest = std::numeric_limits<double>::infinity(), sum.highest = -sum.lowest;
    bool known = true;
    const auto border = [&](int axis, bool most) {
        double value = polygon[0][axis];
        for (const glm::dvec2& corner : polygon)
            value = most ? std::max(value, corner[axis]) : std::min(value, corner[axis]);
        return static_cast<int>(most ? std::ceil(value) : std::floor(value));
    };
    for (int j = border(1, false); j < border(1, true); ++j) {
        const Corners row = clipped(clipped(polygon, 1, j, true), 1, j + 1, false);
        if (row.size() < 3) continue;
        Corners rest = row;
        for (int i = border(0, false); i < border(0, true) && rest.size() >= 3; ++i) {
            const Corners part = clipped(rest, 0, i + 1, false);
            rest = clipped(rest, 0, i + 1, true);
            if (part.size() < 3) continue;
            const Cell cell(ground, i, j);
            if (std::isfinite(cell.twist))
                addCell(cell, part, plane, sum);
            else
                for (std::size_t n = 2; n < part.size(); ++n)
                    sum.plan += Triangle{part[0], part[n - 1], part[n]}.area(), known = false;
        }
    }
    // Clockwise or not is the same area.
    const double sign = sum.plan < 0 ? -1 : 1, unit = sign * ground.spacing().x * ground.spacing().y;
    for (double AreaMeasure::*figure :
         {&AreaMeasure::plan, &AreaMeasure::along, &AreaMeasure::above, &AreaMeasure::below})
        sum.*figure *= unit;
    for (std::size_t n = 0; n < corners.size(); ++n)
        sum.perimeter += glm::length(corners[(n + 1) % corners.size()] - corners[n]);
    if (!known)
        sum.along = sum.above = sum.below = sum.lowest = sum.highest =
            std::numeric_limits<double>::quiet_NaN();
    return sum;
}

AreaMeasure errorsOfArea(const Heightfield& ground, const std::vector<glm::dvec2>& corners, double plane) {
    constexpr double AreaMeasure::*kFigures[] = {&AreaMeasure::along, &AreaMeasure::above,
                                                 &AreaMeasure::below, &AreaMeasure::lowest,
                                                 &AreaMeasure::highest};
    const std::vector<double> found =
        errorsOfSpacing(ground, [&](const Heightfield& other, const glm::dvec2& shift) {
            std::vector<glm::dvec2> moved = corners;
            for (glm::dvec2& corner : moved) corner -= shift;
            const AreaMeasure measure = measureArea(other, moved, plane);
            std::vector<double> values;
            for (const auto figure : kFigures) values.push_back(measure.*figure);
            return values;
        });
    AreaMeasure errors;
    for (std::size_t n = 0; n < found.size(); ++n) errors.*kFigures[n] = found[n];
    return errors;
}

}  // namespace stereonav
