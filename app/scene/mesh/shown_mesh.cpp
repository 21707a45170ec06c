#include "app/scene/mesh/shown_mesh.h"

#include <algorithm>
#include <cmath>

#include "app/scene/mesh/mesh_facts.h"
#include "app/scene/type/outside_view.h"

namespace stereonav {
namespace {

constexpr float kAmbient = 0.1f;
constexpr double kWrap = 1;  // half of all views see sides that the sun does not reach

// Returns the direction for an azimuth clockwise from north (+y) and an elevation; negative elevations are
// allowed, for hanging objects.
glm::dvec3 directionTo(const SunPlace& place) {
    const double level = std::cos(place.elevation);
    return {level * std::sin(place.azimuth), level * std::cos(place.azimuth), std::sin(place.elevation)};
}

}  // namespace

void ShownMesh::Sun::turnTo(const SunPlace& place) {
    mPlace = place;
    mRenderer.setLight({directionTo(place), kAmbient, kWrap});
}

ShownMesh::ShownMesh(MeshCaster caster, const SunPlace& sun, SimdTarget target)
    : mRenderer(std::move(caster)),
      mRays{&mRenderer},
      mFrames(mRenderer),
      mSun(mRenderer),
      mBox{mRenderer.caster().low(), mRenderer.caster().high()} {
    simd = availableTarget(target);
    mSun.turnTo(sun);
    seeFromOutside(mRenderer.caster().low(), mRenderer.caster().high(), SeenAs::Mesh,
                   "the flight around the mesh", *this);
    offer(mRays);
    offer<const MeshRenderer>(mRenderer);
    offer<TurningLight>(mSun);
    offer(std::as_const(mBox));
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
