#include "colon/instruments/polyp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kNeck = 0.7;        // share of a head's width: an outline that is narrower is a neck
constexpr double kLeastShare = 0.1;  // share of the tip's bulge: less is no part of the head

// Part of the wall around a tip, with its smaller curvature, smoothed.
class Neighbourhood {
public:
    Neighbourhood(const WallMesh& mesh, const WallNeighbours& neighbours, std::uint32_t around,
                  const PolypSetting& setting)
        : mMesh(mesh), mNeighbours(neighbours), mSetting(setting), mAround(around) {}

    // 1/metre; each vertex is worked out once.
    double bulge(std::uint32_t vertex) {
        const auto [at, isNew] = mSmooth.try_emplace(vertex, 0);
        if (!isNew) return at->second;
        double sum = 0, weights = 0;
        const auto add = [&](std::uint32_t v, double weight) {
            weight *= mMesh.areas[v];
            sum += weight * raw(v);
            weights += weight;
        };
        add(vertex, 1);
        for (std::uint32_t k = mNeighbours.first[vertex]; k < mNeighbours.first[vertex + 1]; ++k)
            add(mNeighbours.neighbours[k], 0.5);
        return mSmooth[vertex] = weights > 0 ? sum / weights : 0;
    }

    // The most curved vertex next to the place.
    std::uint32_t tip() {
        std::uint32_t best = mAround;
        for (const std::uint32_t v : verticesAround(mMesh, mNeighbours, mAround, mSetting.reach))
            if (bulge(v) > bulge(best)) best = v;
        return best;
    }

    // All that hangs together with the tip and bulges; empty where it gets too far.
    std::vector<std::uint32_t> headAround(std::uint32_t tip) {
        std::vector<std::uint32_t> head{tip};
        std::unordered_set<std::uint32_t> known{tip};
        const glm::dvec3 middle(mMesh.places[tip]);
        const double least = kLeastShare * bulge(tip);
        for (std::size_t n = 0; n < head.size(); ++n)
            for (std::uint32_t k = mNeighbours.first[head[n]]; k < mNeighbours.first[head[n] + 1]; ++k) {
                const std::uint32_t next = mNeighbours.neighbours[k];
                if (known.contains(next) || bulge(next) <= least) continue;
                if (glm::distance(glm::dvec3(mMesh.places[next]), middle) > mSetting.largest) return {};
                known.insert(next);
                head.push_back(next);
            }
        std::sort(head.begin(), head.end());
        return head;
    }

    // Returns the head without tails of a vertex or two, as noise makes them on stalks: what has neighbours
    // of the head alone, as far as it hangs together with the tip, and its neighbours. A head too small for
    // that stays as it is.
    std::vector<std::uint32_t> withoutTails(const std::vector<std::uint32_t>& head, std::uint32_t tip) const {
        const auto within = [&](std::uint32_t v) { return std::binary_search(head.begin(), head.end(), v); };
        const auto neighboursOfVertex = [&](std::uint32_t v) {
            return std::span(mNeighbours.neighbours)
                .subspan(mNeighbours.first[v], mNeighbours.first[v + 1] - mNeighbours.first[v]);
        };
        const auto deep = [&](std::uint32_t v) { return std::ranges::all_of(neighboursOfVertex(v), within); };
        if (!deep(tip)) return head;
        std::vector<std::uint32_t> core{tip};
        std::unordered_set<std::uint32_t> kept{tip};
        for (std::size_t n = 0; n < core.size(); ++n)
            for (const std::uint32_t next : neighboursOfVertex(core[n]))
                if (within(next) && kept.insert(next).second && deep(next)) core.push_back(next);
        std::vector<std::uint32_t> result(kept.begin(), kept.end());
        std::sort(result.begin(), result.end());
        return result;
    }

    // The first places beyond: fitting curvatures draws their change of sign inwards by about so much.
    std::vector<glm::dvec3> outlineOf(const std::vector<std::uint32_t>& head) const {
        std::vector<std::uint32_t> beyond;
        for (const std::uint32_t in : head)
            for (std::uint32_t k = mNeighbours.first[in]; k < mNeighbours.first[in + 1]; ++k)
                if (const std::uint32_t out = mNeighbours.neighbours[k];
                    !std::binary_search(head.begin(), head.end(), out))
                    beyond.push_back(out);
        std::sort(beyond.begin(), beyond.end());
        beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
        std::vector<glm::dvec3> outline;
        outline.reserve(beyond.size());
        for (const std::uint32_t v : beyond) outline.emplace_back(mMesh.places[v]);
        return outline;
    }

private:
    double raw(std::uint32_t vertex) {
        const auto [at, isNew] = mRaw.try_emplace(vertex, 0);
        if (isNew) at->second = curvaturesAt(mMesh, mNeighbours, vertex, mSetting.curvatureRadius).smaller;
        return at->second;
    }

    const WallMesh& mMesh;
    const WallNeighbours& mNeighbours;
    PolypSetting mSetting;
    std::uint32_t mAround;
    std::unordered_map<std::uint32_t, double> mRaw, mSmooth;
};

PolypWidth widestOf(const std::vector<glm::dvec3>& places) {
    PolypWidth widest;
    for (std::size_t a = 0; a < places.size(); ++a)
        for (std::size_t b = a + 1; b < places.size(); ++b) {
            const glm::dvec3 way = places[a] - places[b];
            if (const double squared = glm::dot(way, way); squared > widest.length * widest.length)
                widest = {std::sqrt(squared), places[a], places[b]};
        }
    return widest;
}

// Returns those of many places that may be an end of the widest distance: the furthest ones in directions all
// around.
std::vector<glm::dvec3> extremesOf(const std::vector<glm::dvec3>& places) {
    constexpr int kDirections = 400;
    std::vector<glm::dvec3> ends;
    for (int n = 0; n < kDirections && !places.empty(); ++n) {
        // Even on the sphere: a spiral of golden angles.
        const double z = 1 - (2 * n + 1.0) / kDirections, flat = std::sqrt(1 - z * z),
                     turn = 2.399963229728653 * n;
        const glm::dvec3 direction(flat * std::cos(turn), flat * std::sin(turn), z);
        ends.push_back(*std::max_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
            return glm::dot(a, direction) < glm::dot(b, direction);
        }));
    }
    return ends;
}

bool holds(const MeasuredPolyp& polyp, std::uint32_t vertex) {
    return std::binary_search(polyp.vertices.begin(), polyp.vertices.end(), vertex);
}

// Triangles with all corners in the head.
std::vector<std::array<std::uint32_t, 3>> trianglesOf(const WallMesh& mesh, const MeasuredPolyp& polyp) {
    std::vector<std::array<std::uint32_t, 3>> inside;
    const std::uint32_t first = polyp.vertices.front(), last = polyp.vertices.back();
    for (const auto& t : mesh.triangles)
        if (t[0] >= first && t[0] <= last && holds(polyp, t[0]) && holds(polyp, t[1]) && holds(polyp, t[2]))
            inside.push_back(t);
    return inside;
}

// Measures in planes of voxels half a millimetre apart, as a reader would page through slices.
void measureSlices(const WallMesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                   MeasuredPolyp& polyp) {
    constexpr double kApart = 0.0005, kMostPlanes = 4000;
    for (int axis = 0; axis < 3; ++axis) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::uint32_t v : polyp.vertices) {
            low = std::min<double>(low, mesh.places[v][axis]);
            high = std::max<double>(high, mesh.places[v][axis]);
        }
        const double apart = std::max(kApart, (high - low) / kMostPlanes);
        for (double at = std::ceil(low / apart) * apart; at <= high; at += apart) {
            std::vector<glm::dvec3> cut;
            for (const auto& t : triangles)
                for (int n = 0; n < 3; ++n) {
                    const glm::dvec3 a(mesh.places[t[n]]), b(mesh.places[t[(n + 1) % 3]]);
                    if ((a[axis] < at) == (b[axis] < at)) continue;
                    cut.push_back(glm::mix(a, b, (at - a[axis]) / (b[axis] - a[axis])));
                }
            const PolypWidth widest = widestOf(cut);
            if (widest.length <= polyp.widestInSlice.length) continue;
            polyp.widestInSlice = widest;
            polyp.sliceAxis = axis;
            polyp.slice = at;
        }
    }
}

void measure(const WallMesh& mesh, MeasuredPolyp& polyp) {
    std::vector<glm::dvec3> places = polyp.outline;
    glm::dvec3 sum(0.0), normals(0.0);
    for (const std::uint32_t v : polyp.vertices) {
        places.emplace_back(mesh.places[v]);
        sum += static_cast<double>(mesh.areas[v]) * glm::dvec3(mesh.places[v]);
        normals += static_cast<double>(mesh.areas[v]) * glm::dvec3(mesh.normals[v]);
        polyp.area += mesh.areas[v];
    }
    polyp.middle = sum / polyp.area;
    const double length = glm::length(normals);
    polyp.outward = length > 0 ? normals / length : glm::dvec3(mesh.normals[polyp.tip]);
    // A head on a stalk ends at its neck: what lies beyond is the stalk's.
    const PolypWidth head = widestOf(
        extremesOf({places.begin() + static_cast<std::ptrdiff_t>(polyp.outline.size()), places.end()}));
    const bool neck = widestOf(extremesOf(polyp.outline)).length < kNeck * head.length;
    polyp.widest = neck ? head : widestOf(extremesOf(places));
    const auto triangles = trianglesOf(mesh, polyp);
    measureSlices(mesh, triangles, polyp);
    glm::dvec3 lid(0.0);
    for (const glm::dvec3& place : polyp.outline) lid += place / static_cast<double>(polyp.outline.size());
    double volume = 0;  // under triangles, from the lid's middle: those of the lid itself add nothing
    for (const auto& t : triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.places[t[0]]) - lid, b = glm::dvec3(mesh.places[t[1]]) - lid,
                         c = glm::dvec3(mesh.places[t[2]]) - lid;
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    polyp.volume = std::abs(volume);
}

}  // namespace

PolypSetting polypSettingOf(const VolumeFrame& frame) {
    PolypSetting setting;
    const double voxel = std::max({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    setting.curvatureRadius = std::max(setting.curvatureRadius, 1.6 * voxel);
    setting.leastVolume = 6 * frame.spacing.x * frame.spacing.y * frame.spacing.z;
    setting.leastScore = 0.5 * voxel;
    return setting;
}

std::uint32_t nearestVertex(const WallMesh& mesh, const glm::dvec3& place) {
    if (mesh.places.empty()) throw Error("wall", "", "expected a wall, found none", "choose another study");
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t v = 0; v < mesh.places.size(); ++v) {
        const glm::dvec3 to = glm::dvec3(mesh.places[v]) - place;
        if (const double squared = glm::dot(to, to); squared < least) least = squared, best = v;
    }
    return best;
}

std::optional<MeasuredPolyp> polypAt(const WallMesh& mesh, const WallNeighbours& neighbours,
                                     const glm::dvec3& place, const PolypSetting& setting, std::string& why) {
    const std::uint32_t nearest = nearestVertex(mesh, place);
    if (!(glm::distance(glm::dvec3(mesh.places[nearest]), place) <= setting.fromWall)) {
        why = fmt::format("no wall of the colon is within {:g} mm", 1e3 * setting.fromWall);
        return std::nullopt;
    }
    return polypAt(mesh, neighbours, nearest, setting, why);
}

std::optional<MeasuredPolyp> polypAt(const WallMesh& mesh, const WallNeighbours& neighbours,
                                     std::uint32_t vertex, const PolypSetting& setting, std::string& why) {
    Neighbourhood around(mesh, neighbours, vertex, setting);
    MeasuredPolyp polyp;
    polyp.tip = around.tip();
    if (!(around.bulge(polyp.tip) >= setting.flattest)) {
        why = "nothing bulges into the lumen there";
        return std::nullopt;
    }
    polyp.vertices = around.headAround(polyp.tip);
    if (polyp.vertices.empty()) {
        why = fmt::format("what bulges there is wider than {:g} mm", 1e3 * setting.largest);
        return std::nullopt;
    }
    polyp.vertices = around.withoutTails(polyp.vertices, polyp.tip);
    polyp.outline = around.outlineOf(polyp.vertices);
    measure(mesh, polyp);
    if (polyp.volume < setting.leastVolume || polyp.score() < setting.leastScore) {
        why = fmt::format("what bulges there, {:.1f} mm wide and {:.1f} mm^3, can not be told from noise",
                          1e3 * polyp.widest.length, 1e9 * polyp.volume);
        return std::nullopt;
    }
    return polyp;
}

}  // namespace stereonav
