#include "terrain/survey/ground_line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace stereonav {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// A piece of a line inside one cell: heights and slopes (metres a metre of the plan) at its ends.
struct LinePiece {
    double length, height0, height1, slope0, slope1;
    bool known;
};

// The length of a curve whose slope goes evenly from one value to another, over a length of the plan.
double curveLength(double length, double slope0, double slope1) {
    const double change = slope1 - slope0;
    constexpr double kLittle = 1e-2;
    if (std::abs(change) > kLittle) {
        const auto whole = [](double g) { return 0.5 * (g * std::sqrt(1 + g * g) + std::asinh(g)); };
        return length * (whole(slope1) - whole(slope0)) / change;
    }
    // The difference above would cancel: three places of Gauss, exact to the sixth power of the change.
    const double middle = 0.5 * (slope0 + slope1), off = 0.5 * std::sqrt(0.6) * change;
    const auto at = [](double g) { return std::sqrt(1 + g * g); };
    return length * (5 * at(middle - off) + 8 * at(middle) + 5 * at(middle + off)) / 18;
}

// Cells beyond the border go on as the last one does, for thinned grounds.
LinePiece pieceOf(const GroundSamples& ground, const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 middle = 0.5 * (from + to);
    const int i = std::clamp(static_cast<int>(std::floor(middle.x)), 0, ground.width() - 2),
              j = std::clamp(static_cast<int>(std::floor(middle.y)), 0, ground.height() - 2);
    const double a = ground.sample(i, j), b = ground.sample(i + 1, j);
    const double c = ground.sample(i, j + 1), d = ground.sample(i + 1, j + 1), twist = a - b - c + d;
    const auto height = [&](const glm::dvec2& g) {
        const double u = g.x - i, v = g.y - j;
        return a + (b - a) * u + (c - a) * v + twist * u * v;
    };
    const double length = glm::length((to - from) * ground.spacing());
    const glm::dvec2 step = (to - from) / length;
    const auto slope = [&](const glm::dvec2& g) {
        return (b - a + twist * (g.y - j)) * step.x + (c - a + twist * (g.x - i)) * step.y;
    };
    return {length, height(from), height(to), slope(from), slope(to), std::isfinite(twist)};
}

// Shares of the way at which it crosses columns and rows; 0 and 1 among them.
std::vector<double> crossings(const glm::dvec2& from, const glm::dvec2& to) {
    std::vector<double> shares{0, 1};
    for (const int axis : {0, 1}) {
        const double low = std::min(from[axis], to[axis]), high = std::max(from[axis], to[axis]);
        for (double line = std::floor(low) + 1; line < high; ++line)
            shares.push_back((line - from[axis]) / (to[axis] - from[axis]));
    }
    std::sort(shares.begin(), shares.end());
    // A crossing of a row and a column at the same place, except for rounding, counts as one.
    constexpr double kSame = 1e-12;
    shares.erase(std::unique(shares.begin(), shares.end(), [](double a, double b) { return b - a < kSame; }),
                 shares.end());
    shares.back() = 1;
    return shares;
}

// Calls piece(from, to, piece) for each in turn; grid units.
template <typename Each>
void eachPiece(const GroundSamples& ground, const std::vector<glm::dvec2>& world, const Each& each) {
    for (std::size_t n = 1; n < world.size(); ++n) {
        const glm::dvec2 from = ground.gridFromWorld(world[n - 1]), to = ground.gridFromWorld(world[n]);
        if (from == to) continue;
        glm::dvec2 last = from;
        const std::vector<double> shares = crossings(from, to);
        for (std::size_t k = 1; k < shares.size(); ++k) {
            const glm::dvec2 next = shares[k] == 1 ? to : from + shares[k] * (to - from);
            if (next == last) continue;
            each(last, next, pieceOf(ground, last, next));
            last = next;
        }
    }
}

// Returns how far a piece, whose height is a parabola, goes up and how far down.
glm::dvec2 climbOf(const LinePiece& piece) {
    const auto way = [](double rise) { return glm::dvec2(std::max(rise, 0.0), std::max(-rise, 0.0)); };
    if (piece.slope0 * piece.slope1 >= 0) return way(piece.height1 - piece.height0);
    const double turn = piece.length * piece.slope0 / (piece.slope0 - piece.slope1);
    const double first = 0.5 * piece.slope0 * turn, second = 0.5 * piece.slope1 * (piece.length - turn);
    return way(first) + way(second);
}

double heightOn(const GroundSamples& ground, const glm::dvec2& world) {
    const glm::dvec2 grid = ground.gridFromWorld(world);
    const LinePiece piece = pieceOf(ground, grid, grid + glm::dvec2(1e-9, 0));
    return piece.known ? piece.height0 : kNotKnown;
}

}  // namespace

std::vector<LinePoint> groundLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world) {
    std::vector<LinePoint> points;
    eachPiece(ground, world, [&](const glm::dvec2& from, const glm::dvec2& to, const LinePiece& piece) {
        if (points.empty())
            points.push_back({0, ground.worldFromGrid(from), piece.known ? piece.height0 : kNotKnown, 0});
        LinePoint next = points.back();
        next.distance += piece.length;
        next.along += piece.known ? curveLength(piece.length, piece.slope0, piece.slope1) : piece.length;
        next.world = ground.worldFromGrid(to);
        next.height = piece.known ? piece.height1 : kNotKnown;
        // The edge of a hole is known from the side that is.
        if (piece.known && !std::isfinite(points.back().height)) points.back().height = piece.height0;
        points.push_back(next);
    });
    return points;
}

LineMeasure measureLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world) {
    LineMeasure all;
    all.lowest = std::numeric_limits<double>::infinity(), all.highest = -all.lowest;
    bool known = true;
    eachPiece(ground, world, [&](const glm::dvec2&, const glm::dvec2&, const LinePiece& piece) {
        all.plan += piece.length;
        known = known && piece.known;
        all.along += curveLength(piece.length, piece.slope0, piece.slope1);
        const glm::dvec2 way = climbOf(piece);
        all.climb += way.x, all.descent += way.y;
        // The parabola's top or bottom, where it lies inside.
        const double top = piece.height0 + (piece.slope0 > 0 ? way.x : -way.y);
        const bool turns = piece.slope0 * piece.slope1 < 0;
        all.lowest = std::min({all.lowest, piece.height0, piece.height1, turns ? top : piece.height0});
        all.highest = std::max({all.highest, piece.height0, piece.height1, turns ? top : piece.height0});
    });
    for (std::size_t n = 1; n < world.size(); ++n)
        all.straight += std::hypot(glm::length(world[n] - world[n - 1]),
                                   heightOn(ground, world[n]) - heightOn(ground, world[n - 1]));
    all.rise = heightOn(ground, world.back()) - heightOn(ground, world.front());
    if (!known) all.along = all.climb = all.descent = all.lowest = all.highest = kNotKnown;
    return all;
}

std::vector<double> errorsOfSpacing(const GroundSamples& ground, const std::vector<double>& whole,
                                    const FiguresOfGround& figures) {
    if (ground.width() < 4 || ground.height() < 4) return std::vector<double>(whole.size(), kNotKnown);
    std::vector<double> most(whole.size(), 0.0);
    for (const int firstX : {0, 1})
        for (const int firstY : {0, 1}) {
            glm::dvec2 shift;
            const GroundSamples thin = ground.thinned(firstX, firstY, shift);
            const std::vector<double> coarse = figures(thin, shift);
            for (std::size_t n = 0; n < whole.size(); ++n) {
                const double change = std::abs(coarse[n] - whole[n]);
                if (!(change <= most[n])) most[n] = change;  // no number stays one
            }
        }
    return most;
}

LineMeasure errorsOfLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world,
                         const LineMeasure& measured) {
    constexpr double LineMeasure::*kFigures[] = {
        &LineMeasure::straight, &LineMeasure::along,  &LineMeasure::rise,   &LineMeasure::climb,
        &LineMeasure::descent,  &LineMeasure::lowest, &LineMeasure::highest};
    const auto valuesOf = [&](const LineMeasure& measure) {
        std::vector<double> values;
        values.reserve(std::size(kFigures));
        for (const auto figure : kFigures) values.push_back(measure.*figure);
        return values;
    };
    const std::vector<double> found =
        errorsOfSpacing(ground, valuesOf(measured), [&](const GroundSamples& other, const glm::dvec2& shift) {
            std::vector<glm::dvec2> moved = world;
            for (glm::dvec2& place : moved) place -= shift;
            return valuesOf(measureLine(other, moved));
        });
    LineMeasure errors;
    for (std::size_t n = 0; n < found.size(); ++n) errors.*kFigures[n] = found[n];
    return errors;
}

}  // namespace stereonav
