#include "colon/instruments/polyp_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr double kAir = -800, kTissue = -200;  // HU: below, above
constexpr std::size_t kProfiles = 4000;        // at most
constexpr std::size_t kLeastProfiles = 100;
constexpr int kSteps = 40;  // steps of a profile, to each side of the wall

double storedAt(const GreyVolume& study, const glm::ivec3& voxel) {
    return study.at(voxel) * study.scale + study.offset;
}

// Returns the trilinear value; NaN beyond the study.
double valueAt(const GreyVolume& study, const glm::dvec3& world) {
    const glm::dvec3 place = study.frame.voxelFromWorld(world), low = glm::floor(place), part = place - low;
    const glm::ivec3 first(low);
    if (!study.frame.contains(first) || !study.frame.contains(first + 1)) return std::nan("");
    double value = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 share = glm::mix(1.0 - part, part, glm::dvec3(at));
        value += share.x * share.y * share.z * storedAt(study, first + at);
    }
    return value;
}

double medianOf(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

using Profile = std::array<double, 2 * kSteps + 1>;

// Finds the profile along a vertex's normal, `far` metres to each side, from air (0) to tissue (1). Returns
// false where either is missing.
bool profileAt(const GreyVolume& study, const WallMesh& wall, std::size_t vertex, double far,
               Profile& profile) {
    const glm::dvec3 place(wall.places[vertex]), inwards = -glm::dvec3(wall.normals[vertex]);
    for (int n = 0; n <= 2 * kSteps; ++n)
        profile[n] = valueAt(study, place + far * (static_cast<double>(n) / kSteps - 1) * inwards);
    constexpr int kEnd = kSteps / 5;
    double air = 0, tissue = 0;
    for (int n = 0; n < kEnd; ++n) {
        // The largest value on the air side and the smallest on the tissue side decide; NaN fails too.
        if (!(profile[n] < kAir && profile[2 * kSteps - n] > kTissue)) return false;
        air += profile[n] / kEnd;
        tissue += profile[2 * kSteps - n] / kEnd;
    }
    for (double& value : profile) value = (value - air) / (tissue - air);
    return true;
}

// Vertices of the wall near a polyp, and for each whether it is the polyp's own.
struct NearWall {
    std::vector<glm::dvec3> places, normals;
    std::vector<char> ofHead;
};

NearWall wallAround(const WallMesh& wall, const MeasuredPolyp& polyp, const glm::dvec3& low,
                    const glm::dvec3& high) {
    NearWall near;
    for (std::size_t v = 0; v < wall.places.size(); ++v) {
        const glm::dvec3 place(wall.places[v]);
        if (glm::any(glm::lessThan(place, low)) || glm::any(glm::greaterThan(place, high))) continue;
        near.places.push_back(place);
        near.normals.emplace_back(wall.normals[v]);
        near.ofHead.push_back(
            std::binary_search(polyp.vertices.begin(), polyp.vertices.end(), static_cast<std::uint32_t>(v)));
    }
    return near;
}

// Returns whether a place is inside the flesh of the polyp and at least `away` from all wall.
bool isDeepInside(const NearWall& near, const glm::dvec3& place, double away) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (std::size_t n = 0; n < near.places.size(); ++n) {
        const glm::dvec3 to = near.places[n] - place;
        const double squared = glm::dot(to, to);
        if (squared >= least) continue;
        if (squared < away * away) return false;
        least = squared;
        nearest = n;
    }
    return std::isfinite(least) && near.ofHead[nearest] &&
           glm::dot(place - near.places[nearest], near.normals[nearest]) < 0;
}

PolypValues valuesOf(const std::vector<double>& values) {
    PolypValues told;
    told.voxels = static_cast<int>(values.size());
    for (const double value : values) told.mean += value / told.voxels;
    double squares = 0;
    for (const double value : values) squares += (value - told.mean) * (value - told.mean);
    told.sigma = std::sqrt(squares / (told.voxels - 1));
    return told;
}

}  // namespace

std::optional<double> blurAcrossWall(const GreyVolume& study, const WallMesh& wall) {
    const glm::dvec3& spacing = study.frame.spacing;
    const double far = std::max(0.004, 2 * std::max({spacing.x, spacing.y, spacing.z}));
    const std::size_t every = std::max<std::size_t>(wall.places.size() / kProfiles, 1);
    std::vector<Profile> profiles;
    Profile profile;
    for (std::size_t v = 0; v < wall.places.size(); v += every)
        if (profileAt(study, wall, v, far, profile)) profiles.push_back(profile);
    if (profiles.size() < kLeastProfiles) return std::nullopt;
    std::vector<double> values(profiles.size());
    for (int n = 0; n <= 2 * kSteps; ++n) {
        for (std::size_t p = 0; p < profiles.size(); ++p) values[p] = profiles[p][n];
        profile[n] = medianOf(values);
    }
    double steepest = 0;  // steepest slope, per metre
    for (int n = 2; n <= 2 * kSteps - 2; ++n)
        steepest = std::max(steepest, (profile[n + 2] - profile[n - 2]) * kSteps / (4 * far));
    if (!(steepest > 0)) return std::nullopt;
    return 1 / (std::sqrt(2 * std::numbers::pi) * steepest);
}

std::optional<PolypValues> valuesInside(const GreyVolume& study, const WallMesh& wall,
                                        const MeasuredPolyp& polyp, double blur) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low), lid(0.0);
    const auto include = [&](const glm::dvec3& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    };
    for (const std::uint32_t v : polyp.vertices) include(glm::dvec3(wall.places[v]));
    for (const glm::dvec3& place : polyp.outline) {
        include(place);
        lid += place / static_cast<double>(polyp.outline.size());
    }
    const double away = kBlurReaches * blur;
    // Bound of the distance to the polyp's own wall from any place inside.
    const double margin = std::max({0.5 * glm::length(high - low), away});
    const NearWall near = wallAround(wall, polyp, low - margin, high + margin);
    glm::ivec3 first(study.frame.size), last(0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at = glm::mix(low, high, glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2));
        const glm::dvec3 voxel = study.frame.voxelFromWorld(at);
        first = glm::min(first, glm::ivec3(glm::floor(voxel)));
        last = glm::max(last, glm::ivec3(glm::ceil(voxel)));
    }
    first = glm::max(first, glm::ivec3(0));
    last = glm::min(last, study.frame.size - 1);
    std::vector<std::vector<double>> slices(static_cast<std::size_t>(std::max(last.z - first.z + 1, 0)));
    parallelFor(static_cast<int>(slices.size()), [&](int slice) {
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i) {
                const glm::ivec3 voxel(i, j, first.z + slice);
                const glm::dvec3 place = study.frame.worldFromVoxel(glm::dvec3(voxel));
                if (glm::dot(place - lid, polyp.outward) > 0 && isDeepInside(near, place, away))
                    slices[slice].push_back(storedAt(study, voxel));
            }
    });
    std::vector<double> values;
    for (const auto& slice : slices) values.insert(values.end(), slice.begin(), slice.end());
    if (static_cast<int>(values.size()) < kLeastVoxels) return std::nullopt;
    return valuesOf(values);
}

}  // namespace stereonav
