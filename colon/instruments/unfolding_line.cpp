#include "colon/instruments/unfolding_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "colon/instruments/smooth_row.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr double kSmoothLine = 6;     // frames, sigma
constexpr double kStraightOn = 0.1;   // metres beyond an end at most
constexpr double kLongestLine = 100;  // metres: frames are held, and each is near to some of the wall
constexpr int kEndFrames = 10;        // whose way the line goes on in
constexpr int kOfOneTask = 4096;      // vertices

std::vector<glm::dvec3> evenPlaces(const Centreline& line, double step) {
    std::vector<glm::dvec3> places;
    double walked = 0;
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const glm::dvec3& to = line.points[n].position;
        const glm::dvec3 from = n > 0 ? line.points[n - 1].position : to;
        const double way = glm::distance(from, to);
        while (static_cast<double>(places.size()) * step <= walked + way) {
            const double t = way > 0 ? (static_cast<double>(places.size()) * step - walked) / way : 0;
            places.push_back(glm::mix(from, to, t));
        }
        walked += way;
    }
    return places;
}

// Smooths how far places lie off a straight way between the ends, which stay.
void smoothPlaces(std::vector<glm::dvec3>& places) {
    const glm::dvec3 first = places.front(), last = places.back();
    const double count = static_cast<double>(places.size() - 1);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> row(places.size());
        const auto straight = [&](std::size_t n) {
            return first[axis] + (last[axis] - first[axis]) * (static_cast<double>(n) / count);
        };
        for (std::size_t n = 0; n < row.size(); ++n) row[n] = places[n][axis] - straight(n);
        smoothRow(row, kSmoothLine, false);
        for (std::size_t n = 1; n + 1 < row.size(); ++n) places[n][axis] = row[n] + straight(n);
    }
}

glm::dvec3 wayOut(const std::vector<glm::dvec3>& places, bool atEnd) {
    const std::size_t back = std::min<std::size_t>(kEndFrames, places.size() - 1);
    const glm::dvec3 way =
        atEnd ? places.back() - places[places.size() - 1 - back] : places[0] - places[back];
    return glm::normalize(way + glm::dvec3(0, 0, 1e-12));
}

// Returns by neighbour, in the order of WallNeighbours, half the cotangents of the angles opposite to each
// edge, which is the Laplacian of linear elements (Pinkall and Polthier, "Computing discrete minimal surfaces
// and their conjugates", Experimental Mathematics 2 (1993)). Negative and very large ones, of slivers, are
// cut off.
std::vector<float> cotangents(const WallMesh& mesh, const WallNeighbours& neighbours) {
    std::vector<float> weights(neighbours.neighbours.size(), 0.0f);
    const auto add = [&](std::uint32_t from, std::uint32_t to, float weight) {
        const auto first = neighbours.neighbours.begin() + neighbours.first[from];
        const auto last = neighbours.neighbours.begin() + neighbours.first[from + 1];
        weights[std::lower_bound(first, last, to) - neighbours.neighbours.begin()] += weight;
    };
    for (const auto& t : mesh.triangles)
        for (int n = 0; n < 3; ++n) {
            const std::uint32_t a = t[(n + 1) % 3], b = t[(n + 2) % 3];
            const glm::vec3 toA = mesh.places[a] - mesh.places[t[n]],
                            toB = mesh.places[b] - mesh.places[t[n]];
            const float doubled = glm::length(glm::cross(toA, toB));
            const float weight = doubled > 0 ? 0.5f * glm::dot(toA, toB) / doubled : 0.0f;
            add(a, b, weight);
            add(b, a, weight);
        }
    for (float& weight : weights) weight = std::clamp(weight, 0.01f, 3.0f);
    return weights;
}

// Fills unknown vertices ring by ring from known ones outward, with the mean of what is known next to each.
void fillUnknown(const WallNeighbours& neighbours, std::vector<glm::vec3>& values,
                 std::vector<std::uint8_t> known) {
    std::vector<std::uint32_t> ring, next;
    for (std::uint32_t v = 0; v < known.size(); ++v)
        if (!known[v]) ring.push_back(v);
    while (!ring.empty()) {
        next.clear();
        std::vector<std::pair<std::uint32_t, glm::vec3>> found;
        for (const std::uint32_t v : ring) {
            glm::vec3 sum(0);
            int count = 0;
            for (std::uint32_t k = neighbours.first[v]; k < neighbours.first[v + 1]; ++k)
                if (const std::uint32_t to = neighbours.neighbours[k]; known[to]) sum += values[to], ++count;
            if (count > 0)
                found.emplace_back(v, sum / static_cast<float>(count));
            else
                next.push_back(v);
        }
        if (found.empty()) return;  // joined to nothing that is known
        for (const auto& [v, value] : found) values[v] = value, known[v] = 1;
        std::swap(ring, next);
    }
}

}  // namespace

UnfoldingLine::UnfoldingLine(const Centreline& line, const LineOfSight& sight) {
    if (!(line.length() <= kLongestLine))
        throw Error("unfold", "",
                    fmt::format("expected a centreline of at most {:g} m, found {:.4g} m", kLongestLine,
                                line.length()),
                    "choose another study, or correct its spacing");
    std::vector<glm::dvec3> places = evenPlaces(line, kStep);
    if (places.size() < 3)
        throw Error("unfold", "", "expected a centreline of 2 mm or more", "choose another study");
    smoothPlaces(places);
    mLength = static_cast<double>(places.size() - 1) * kStep;
    const auto straightOn = [&](bool atEnd) {
        std::vector<glm::dvec3> more;
        const glm::dvec3 from = atEnd ? places.back() : places.front(), way = wayOut(places, atEnd);
        const double reach = sight.reach(from, way, kStraightOn);
        for (int n = 1; n * kStep <= reach; ++n) more.push_back(from + n * kStep * way);
        return more;
    };
    const std::vector<glm::dvec3> before = straightOn(false), after = straightOn(true);
    mBefore = static_cast<double>(before.size()) * kStep;
    places.insert(places.begin(), before.rbegin(), before.rend());
    places.insert(places.end(), after.begin(), after.end());
    const int count = static_cast<int>(places.size());
    glm::dvec3 across(0);
    for (int n = 0; n < count; ++n) {
        const glm::dvec3 way = places[std::min(n + 1, count - 1)] - places[std::max(n - 1, 0)];
        // A line that turns back on itself between two frames keeps its way.
        glm::dvec3 tangent = n > 0 ? mFrames.back().tangent : glm::dvec3(0, 0, 1);
        if (glm::length(way) > 0.01 * kStep) tangent = glm::normalize(way);
        if (n == 0) across = std::abs(tangent.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        across -= glm::dot(across, tangent) * tangent;
        if (glm::length(across) < 1e-6)
            across =
                glm::cross(tangent, std::abs(tangent.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
        across = glm::normalize(across);
        mFrames.push_back({places[n], tangent, across, glm::cross(tangent, across)});
    }
}

UnfoldingLine::Frame UnfoldingLine::at(double along) const {
    const double at = std::clamp((along + mBefore) / kStep, 0.0, static_cast<double>(mFrames.size() - 1));
    const auto n = std::min(static_cast<std::size_t>(at), mFrames.size() - 2);
    const double t = at - static_cast<double>(n);
    const Frame &a = mFrames[n], &b = mFrames[n + 1];
    return {glm::mix(a.place, b.place, t), glm::mix(a.tangent, b.tangent, t), glm::mix(a.across, b.across, t),
            glm::mix(a.over, b.over, t)};
}

std::vector<glm::vec3> smoothOverWall(const WallMesh& mesh, const WallNeighbours& neighbours,
                                      std::vector<glm::vec3> values, std::vector<std::uint8_t> known,
                                      double length) {
    fillUnknown(neighbours, values, known);
    if (!(length > 0) || values.empty() || !(mesh.area() > 0)) return values;
    const std::vector<float> weights = cotangents(mesh, neighbours);
    const auto squared = static_cast<float>(length * length);
    // Jacobi's rule leaves (stiff / (1 + stiff))^rounds of a change, about: a thousandth.
    const double stiff = 4 * length * length * static_cast<double>(values.size()) / mesh.area();
    const int rounds = static_cast<int>(std::clamp(7 * (1 + stiff), 20.0, 2000.0));
    const int count = static_cast<int>(values.size());
    const std::vector<glm::vec3> given = values;
    std::vector<glm::vec3> next(values.size());
    for (int round = 0; round < rounds; ++round) {
        parallelFor((count + kOfOneTask - 1) / kOfOneTask, [&](int task) {
            for (int v = task * kOfOneTask; v < std::min((task + 1) * kOfOneTask, count); ++v) {
                const float own = known[v] ? mesh.areas[v] / squared : 0.0f;
                glm::vec3 sum = own * given[v];
                float all = own;
                for (std::uint32_t k = neighbours.first[v]; k < neighbours.first[v + 1]; ++k)
                    sum += weights[k] * values[neighbours.neighbours[k]], all += weights[k];
                next[v] = all > 0 ? sum / all : given[v];
            }
        });
        std::swap(values, next);
    }
    return values;
}

}  // namespace stereonav
