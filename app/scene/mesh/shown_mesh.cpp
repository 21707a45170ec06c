#include "app/scene/mesh/shown_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "app/scene/mesh/mesh_facts.h"
#include "app/scene/type/outside_view.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr float kAmbient = 0.1f;
// Light over the left shoulder of the first viewer, clockwise from where that one looks.
constexpr double kSunAzimuth = 225 * kRadians, kSunElevation = 45 * kRadians;
constexpr double kWrap = 1;  // half of all views see sides that the sun does not reach

// Returns the direction for an azimuth clockwise from north (+y) and an elevation; negative elevations are
// allowed, for hanging objects.
glm::dvec3 directionTo(const SunPlace& place) {
    const double level = std::cos(place.elevation);
    return {level * std::sin(place.azimuth), level * std::cos(place.azimuth), std::sin(place.elevation)};
}

// Returns samples spread over the triangles by area, at their middles where they are small.
std::vector<SurfaceSample> samplesOf(const MeshCaster& caster) {
    constexpr double kMost = 60000;
    const TriangleMesh& mesh = caster.mesh();
    const glm::dvec3 about = 0.5 * (caster.low() + caster.high());  // which the mesh is kept about
    double area = 0;
    const auto cornersOf = [&mesh](const TriangleMesh::Triangle& triangle) {
        return std::array{mesh.vertices[triangle.vertex[0]].position,
                          mesh.vertices[triangle.vertex[1]].position,
                          mesh.vertices[triangle.vertex[2]].position};
    };
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
        const auto [a, b, c] = cornersOf(triangle);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    std::vector<SurfaceSample> samples;
    double due = 0.5;  // samples that the triangles so far should have had, and have not
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
        const auto [a, b, c] = cornersOf(triangle);
        const glm::dvec3 across = glm::cross(b - a, c - a);
        const double twice = glm::length(across);
        const glm::vec3 normal = twice > 0 ? glm::vec3(across / twice) : glm::vec3(0.0f);
        due += area > 0 ? kMost * 0.5 * twice / area : 0;
        const int count = static_cast<int>(std::min(due, kMost));
        due -= count;
        for (int n = 0; n < count; ++n) {
            // A sequence of low discrepancy on the triangle, folded into it.
            glm::dvec2 at(std::fmod(0.5 + 0.7548776662466927 * n, 1.0),
                          std::fmod(0.5 + 0.5698402909980532 * n, 1.0));
            if (at.x + at.y > 1) at = 1.0 - at;
            samples.push_back({about + a + at.x * (b - a) + at.y * (c - a), normal});
        }
    }
    // Corners that stick out may have had no sample.
    const std::size_t step = 1 + mesh.triangles.size() / static_cast<std::size_t>(kMost);
    for (std::size_t n = 0; n < mesh.triangles.size(); n += step)
        for (const glm::dvec3& corner : cornersOf(mesh.triangles[n]))
            samples.push_back({about + corner, glm::vec3(0.0f)});
    return samples;
}

}  // namespace

void ShownMesh::Sun::turnTo(const SunPlace& place) {
    mPlace = place;
    mRenderer.setLight({directionTo(place), kAmbient, kWrap});
}

ShownMesh::ShownMesh(MeshCaster caster, const SceneOptions& options, SimdTarget target)
    : mRenderer(std::move(caster)),
      mRays{&mRenderer},
      mFrames(mRenderer),
      mSun(mRenderer),
      mBox{mRenderer.caster().low(), mRenderer.caster().high()},
      mOutside{mBox.low, mBox.high} {
    simd = availableTarget(target);
    constexpr const char* kFlight = "the flight around the mesh";
    std::optional<double> turn;
    if (options.chosenLook)
        turn = seeFromBestSide(samplesOf(mRenderer.caster()), options, SeenAs::Mesh, kFlight, *this);
    if (!turn) seeFromOutside(mBox.low, mBox.high, SeenAs::Mesh, kFlight, *this);
    if (options.sun)
        mSun.turnTo({options.sun->azimuth, options.sun->elevation});
    else
        mSun.turnTo({kSunAzimuth + turn.value_or(0), kSunElevation});
    offer(mRays);
    offer<const MeshRenderer>(mRenderer);
    offer<TurningLight>(mSun);
    offer(std::as_const(mBox));
    offer(std::as_const(mOutside));
}

Facts ShownMesh::describe() const {
    return {factForJson("mesh", factsOfMesh(*this))};
}

std::unique_ptr<Flight> ShownMesh::makeFlight() const {
    const glm::dvec3 size = mRenderer.caster().high() - mRenderer.caster().low();
    const double extent = std::max({size.x, size.y, size.z});
    return freeFlight(startPose, extent > 0 ? extent : 1e-6);
}

}  // namespace stereonav
