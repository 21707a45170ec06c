#include "terrain/survey/ground_area.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "engine/base/parallel.h"
#include "terrain/survey/ground_line.h"

namespace stereonav {
namespace {

using Corners = std::vector<glm::dvec2>;  // grid

// Clips a polygon to one side of a column or row (Sutherland and Hodgman 1974). Where the polygon has dents,
// edges on the line are gone over twice, there and back, which cancels in what is summed over it.
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

// A cell of the grid. Outside the grid it is the nearest cell, continued.
struct Cell {
    int i, j;
    double a, b, c, twist;
    glm::dvec2 spacing;

    Cell(const GroundSamples& ground, int column, int row) : spacing(ground.spacing()) {
        const int x = std::clamp(column, 0, ground.width() - 2), y = std::clamp(row, 0, ground.height() - 2);
        i = x, j = y;
        a = ground.sample(x, y), b = ground.sample(x + 1, y), c = ground.sample(x, y + 1);
        twist = a - b - c + ground.sample(x + 1, y + 1);
    }
    double height(const glm::dvec2& g) const {
        const double u = g.x - i, v = g.y - j;
        return a + (b - a) * u + (c - a) * v + twist * u * v;
    }
    // Area of the surface per area of the plan.
    double stretch(const glm::dvec2& g) const {
        const glm::dvec2 slope = glm::dvec2(b - a + twist * (g.y - j), c - a + twist * (g.x - i)) / spacing;
        return std::sqrt(1 + glm::dot(slope, slope));
    }
};

struct Triangle {
    glm::dvec2 a, b, c;
    double area() const { return 0.5 * crossOf(b - a, c - a); }  // signed, grid units
};

// Returns the surface's area over a triangle, by a quadrature with seven points that is exact for polynomials
// of degree 5 (Radon 1948).
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

// Returns the volumes above and below a plane, in metres of height times the triangle's area. Quadrature at
// the middles of the sides, exact for degree 2.
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

// Sums over a part of an area, in grid units over the plan.
struct PartSum {
    double plan = 0, along = 0, above = 0, below = 0;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    bool known = true;

    void add(const PartSum& other) {
        plan += other.plan, along += other.along, above += other.above, below += other.below;
        lowest = std::min(lowest, other.lowest), highest = std::max(highest, other.highest);
        known = known && other.known;
    }
};

void addHeights(const Cell& cell, const Corners& part, PartSum& sum) {
    sum.known = sum.known && std::isfinite(cell.twist);
    for (const glm::dvec2& corner : part) {
        const double height = cell.height(corner);
        sum.lowest = std::min(sum.lowest, height), sum.highest = std::max(sum.highest, height);
    }
}

void addCell(const Cell& cell, const Corners& part, double plane, PartSum& sum) {
    addHeights(cell, part, sum);
    for (std::size_t n = 2; n < part.size(); ++n) {
        const Triangle triangle{part[0], part[n - 1], part[n]};
        if (triangle.area() == 0) continue;
        sum.plan += triangle.area();
        if (!std::isfinite(cell.twist)) continue;
        sum.along += surfaceOver(cell, triangle);
        const glm::dvec2 volume = volumeOver(cell, triangle, plane, kHalvings);
        sum.above += volume.x, sum.below += volume.y;
    }
}

// A row of cells that an outline covers: the part of the outline in the row, and the winding number of cells
// that its border does not cross.
class CellRow {
public:
    CellRow(const Corners& outline, int row)
        : mRow(row), mPart(clipped(clipped(outline, 1, row, true), 1, row + 1, false)) {
        for (std::size_t n = 0; n < mPart.size(); ++n) {
            const glm::dvec2 &here = mPart[n], &next = mPart[(n + 1) % mPart.size()];
            const bool between = here.y != next.y || (here.y != row && here.y != row + 1);
            if (between)
                mEdges.push_back({std::min(here.x, next.x), std::max(here.x, next.x), here.y - next.y});
        }
    }
    // Calls each(column, part of that cell) from the west to the east.
    template <typename Each>
    void eachCell(const Each& each) const {
        if (mEdges.empty()) return;
        double low = mEdges.front().low, high = mEdges.front().high;
        for (const Edge& edge : mEdges) low = std::min(low, edge.low), high = std::max(high, edge.high);
        for (int i = static_cast<int>(std::floor(low)); i < std::ceil(high); ++i) {
            if (const auto times = timesAround(i)) {
                wholeCell(i, *times, each);
                continue;
            }
            const Corners part = clipped(clipped(mPart, 0, i, true), 0, i + 1, false);
            if (part.size() >= 3) each(i, part);
        }
    }

private:
    struct Edge {
        double low, high, down;
    };
    // Returns the border's winding number around a cell; empty where the border crosses the cell.
    std::optional<int> timesAround(int i) const {
        double times = 0;
        for (const Edge& edge : mEdges) {
            if (edge.low < i + 1 && edge.high > i) return std::nullopt;
            if (edge.high <= i) times += edge.down;
        }
        return static_cast<int>(std::lround(times));
    }
    template <typename Each>
    void wholeCell(int i, int times, const Each& each) const {
        const double x = i, y = mRow;
        Corners cell{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
        if (times < 0) std::reverse(cell.begin(), cell.end());
        for (int n = 0; n < std::abs(times); ++n) each(i, cell);
    }

    int mRow;
    Corners mPart;
    std::vector<Edge> mEdges;
};

// Calls each(cell, part of it, sum) for all cells of an outline. Rows are summed in parallel, then their sums
// are added in the order of the rows.
template <typename Each>
PartSum sumOver(const GroundSamples& ground, const Corners& outline, const Each& each,
                const ShareDone& done) {
    constexpr int kRows = SurveyTiles::kSide;  // rows at once: one tile high, so that each tile is read once
    const auto [south, north] = std::minmax_element(
        outline.begin(), outline.end(), [](const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y; });
    const int end = static_cast<int>(std::ceil(north->y));
    const int begin = static_cast<int>(std::floor(south->y));
    PartSum sum;
    for (int first = begin; first < end; first += kRows) {
        if (done) done(double(first - begin) / (end - begin));
        std::vector<PartSum> rows(static_cast<std::size_t>(std::min(kRows, end - first)));
        parallelFor(static_cast<int>(rows.size()), [&](int n) {
            // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): each row keeps tiles of its own.
            const GroundSamples samples = ground;
            CellRow(outline, first + n).eachCell([&](int i, const Corners& part) {
                each(Cell(samples, i, first + n), part, rows[static_cast<std::size_t>(n)]);
            });
        });
        for (const PartSum& row : rows) sum.add(row);
    }
    return sum;
}

Corners onGrid(const GroundSamples& ground, const std::vector<glm::dvec2>& world) {
    Corners grid;
    grid.reserve(world.size());
    for (const glm::dvec2& corner : world) grid.push_back(ground.gridFromWorld(corner));
    return grid;
}

}  // namespace

AreaMeasure measureArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners, double plane,
                        const ShareDone& done) {
    const PartSum all = sumOver(
        ground, onGrid(ground, corners),
        [plane](const Cell& cell, const Corners& part, PartSum& sum) { addCell(cell, part, plane, sum); },
        done);
    // The sign of the area depends on the direction of the outline, clockwise or not.
    const double sign = all.plan < 0 ? -1 : 1, unit = sign * ground.spacing().x * ground.spacing().y;
    AreaMeasure measure;
    measure.plan = all.plan * unit, measure.along = all.along * unit;
    measure.above = all.above * unit, measure.below = all.below * unit;
    measure.lowest = all.lowest, measure.highest = all.highest;
    for (std::size_t n = 0; n < corners.size(); ++n)
        measure.perimeter += glm::length(corners[(n + 1) % corners.size()] - corners[n]);
    if (!all.known)
        measure.along = measure.above = measure.below = measure.lowest = measure.highest =
            std::numeric_limits<double>::quiet_NaN();
    return measure;
}

double lowestInArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners,
                    const ShareDone& done) {
    const PartSum all = sumOver(ground, onGrid(ground, corners), addHeights, done);
    return all.known ? all.lowest : std::numeric_limits<double>::quiet_NaN();
}

AreaMeasure errorsOfArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners, double plane,
                         const AreaMeasure& measured, const ShareDone& done) {
    constexpr double AreaMeasure::*kFigures[] = {&AreaMeasure::along, &AreaMeasure::above,
                                                 &AreaMeasure::below, &AreaMeasure::lowest,
                                                 &AreaMeasure::highest};
    const auto valuesOf = [&](const AreaMeasure& measure) {
        std::vector<double> values;
        values.reserve(std::size(kFigures));
        for (const auto figure : kFigures) values.push_back(measure.*figure);
        return values;
    };
    constexpr double kPart = 0.25;  // share of the work for each of the four thinned grounds
    double before = 0;
    const std::vector<double> found =
        errorsOfSpacing(ground, valuesOf(measured), [&](const GroundSamples& other, const glm::dvec2& shift) {
            std::vector<glm::dvec2> moved = corners;
            for (glm::dvec2& corner : moved) corner -= shift;
            ShareDone part;
            if (done) part = [&done, before](double share) { done(before + kPart * share); };
            before += kPart;
            return valuesOf(measureArea(other, moved, plane, part));
        });
    AreaMeasure errors;
    for (std::size_t n = 0; n < found.size(); ++n) errors.*kFigures[n] = found[n];
    return errors;
}

}  // namespace stereonav
