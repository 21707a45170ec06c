// See the header.
#include "tests/oracle/plain_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/light/paths/isovalue_surface.h"
#include "engine/light/paths/path_numbers.h"
#include "engine/light/paths/path_scene.h"
#include "engine/math/constants.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

// The unit square onto the unit disc, areas kept (Shirley and Chiu 1997).
glm::dvec2 onDisc(const glm::dvec2& u) {
    const double a = 2 * u.x - 1, b = 2 * u.y - 1;
    if (a == 0 && b == 0) return glm::dvec2(0.0);
    const bool wide = std::abs(a) > std::abs(b);
    const double r = wide ? a : b, angle = kPi / 4 * (wide ? b / a : a / b);
    const double along = r * std::cos(angle), across = r * std::sin(angle);
    return wide ? glm::dvec2(along, across) : glm::dvec2(across, along);
}

// The unit vector with these coordinates across a normal n (Duff et al. 2017) and `up` along it.
glm::dvec3 aroundNormal(const glm::dvec3& n, const glm::dvec2& across, double up) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    const glm::dvec3 s(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), t(b, sign + n.y * n.y * a, -n.y);
    return across.x * s + across.y * t + up * n;
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

PlainPaths::PlainPaths(const GreyVolume& volume, const LightSetup& setup, const TexelSampling& sampling)
    : mVolume(volume), mSetup(setup), mSampling(sampling) {
    if (mSampling.naive)
        mSampling.lowDiscrepancy = mSampling.cosine = mSampling.nextEvent = mSampling.roulette = false;
    mProbeSampled = mSampling.nextEvent && setup.probe && !setup.probe->black();
    mOneLight = choosesLights(setup, mSampling);
    mReach = setup.reach > 0 ? setup.reach : std::numeric_limits<double>::infinity();
}

glm::dvec2 PlainPaths::numbers(const Start& start, std::uint32_t pair, std::uint32_t sample) const {
    return mSampling.lowDiscrepancy ? sobolPair(start.key, pair, sample)
                                    : independentPair(start.key, pair, sample);
}

PlainPaths::Vertex PlainPaths::vertexAt(const glm::dvec3& voxel, const glm::dvec3& normal) const {
    return {voxel, mVolume.frame.worldFromVoxel(voxel), normal};
}

double PlainPaths::directionDensity(double cosine) const {
    return mSampling.cosine ? cosine / kPi : 0.5 / kPi;
}

PlainPaths::Step PlainPaths::chooseDirection(const glm::dvec3& normal, const glm::dvec2& u) const {
    glm::dvec2 across = onDisc(u);
    const double r2 = std::min(glm::dot(across, across), 1.0);
    double up = std::sqrt(1 - r2);
    if (!mSampling.cosine) {  // areas of the disc onto those of the hemisphere
        across *= std::sqrt(2 - r2);
        up = 1 - r2;
    }
    return {aroundNormal(normal, across, up), mSampling.cosine ? 1.0 : 2 * up, directionDensity(up)};
}

bool PlainPaths::blocked(double isovalue, const Vertex& at, const glm::dvec3& direction,
                         double distance) const {
    return castPlainVolume(mVolume, isovalue, {at.world, direction, 0.0}).t < distance;
}

PlainPaths::PointSight PlainPaths::sightOf(const PointLight& light, const Vertex& at) {
    const glm::dvec3 way = light.position - at.world;
    const double distance = glm::length(way), d = std::max(distance, light.radius);
    const glm::dvec3 direction = distance > 0 ? way / distance : at.normal;
    return {direction, distance, std::max(glm::dot(direction, at.normal), 0.0) / (kPi * d * d)};
}

// Returns the light that a white surface sends out by the point lights, which cast hard shadows.
glm::dvec3 PlainPaths::pointLights(double isovalue, const Vertex& at) const {
    glm::dvec3 sum(0.0);
    for (const PointLight& light : mSetup.lights) {
        const PointSight sight = sightOf(light, at);
        if (sight.share > 0 && !blocked(isovalue, at, sight.direction, sight.distance))
            sum += glm::dvec3(light.intensity) * sight.share;
    }
    return sum;
}

glm::dvec3 PlainPaths::onePointLight(double isovalue, const Vertex& at, double u) const {
    double all = 0, sum = 0;
    for (const PointLight& light : mSetup.lights) all += sightOf(light, at).share * lightWeight(light);
    for (const PointLight& light : mSetup.lights) {
        const PointSight sight = sightOf(light, at);
        sum += sight.share * lightWeight(light);
        if (!(u * all < sum)) continue;
        if (blocked(isovalue, at, sight.direction, sight.distance)) break;
        return glm::dvec3(light.intensity) * (all / lightWeight(light));
    }
    return glm::dvec3(0.0);
}

// One sample of the probe by its brightness, weighted by the power heuristic (Veach and Guibas 1995).
glm::dvec3 PlainPaths::sampledProbe(double isovalue, const Vertex& at, const glm::dvec2& u) const {
    const LightProbe::Sample sample = mSetup.probe->sample(glm::vec2(u));
    const glm::dvec3 direction(sample.direction);
    const double cosine = glm::dot(direction, at.normal), density = sample.density;
    if (!(cosine > 0) || !(density > 0)) return glm::dvec3(0.0);
    if (blocked(isovalue, at, direction, mReach)) return glm::dvec3(0.0);
    const double ratio = directionDensity(cosine) / density;
    return glm::dvec3(sample.radiance) * (cosine / (kPi * density * (1 + ratio * ratio)));
}

glm::dvec3 PlainPaths::distantLight(const Step& step) const {
    glm::dvec3 light(mSetup.sky);
    if (!mSetup.probe) return light;
    const glm::vec3 direction(step.direction);
    double weight = 1;
    if (mProbeSampled) {
        const double ratio = mSetup.probe->density(direction) / step.density;
        weight = 1 / (1 + ratio * ratio);
    }
    return light + weight * glm::dvec3(mSetup.probe->radiance(direction));
}

// Calls atVertex(vertex, number, throughput) at each vertex before going on from there.
template <typename AtVertex>
PlainPaths::Escape PlainPaths::walk(const Start& start, std::uint32_t sample, Step& last,
                                    const AtVertex& atVertex) const {
    Vertex at = vertexAt(start.voxel, start.normal);
    glm::dvec3 throughput(1.0);
    for (int vertex = 0;; ++vertex) {
        atVertex(at, vertex, throughput);
        last = chooseDirection(at.normal, numbers(start, pairNumber(vertex, PathPair::Direction), sample));
        throughput *= last.weight;
        const PlainHit hit = castPlainVolume(mVolume, start.isovalue, {at.world, last.direction, 0.0});
        if (!hit.hit() || !(hit.t < mReach)) return {last.direction, throughput};
        if (vertex == mSetup.bounces) return {};
        throughput *= glm::dvec3(mSetup.albedo);
        const double survival = std::min(largest(throughput) / kDim, 1.0);
        if (!(survival > 0)) return {};
        if (mSampling.roulette && survival < 1) {
            const double u = numbers(start, pairNumber(vertex, PathPair::Roulette), sample).x;
            if (!(u < survival)) return {};
            throughput /= survival;
        }
        glm::dvec3 normal = surfaceNormal(mVolume, hit.voxel());
        if (normal == glm::dvec3(0.0)) normal = -last.direction;
        at = vertexAt(liftedStart(mVolume, start.isovalue, hit.voxel(), normal), normal);
    }
}

glm::dvec3 PlainPaths::irradiance(const Start& start, std::uint32_t sample) const {
    glm::dvec3 light(0.0);
    Step last;
    const Escape escape =
        walk(start, sample, last, [&](const Vertex& at, int vertex, const glm::dvec3& throughput) {
            glm::dvec3 direct =
                mOneLight ? onePointLight(start.isovalue, at,
                                          numbers(start, pairNumber(vertex, PathPair::Roulette), sample).y)
                          : pointLights(start.isovalue, at);
            if (mProbeSampled)
                direct += sampledProbe(start.isovalue, at,
                                       numbers(start, pairNumber(vertex, PathPair::Probe), sample));
            light += throughput * direct;
        });
    if (escape.throughput != glm::dvec3(0.0)) light += escape.throughput * distantLight(last);
    return light;
}

PlainPaths::Escape PlainPaths::escape(const Start& start, std::uint32_t sample) const {
    Step last;
    return walk(start, sample, last, [](const Vertex&, int, const glm::dvec3&) {});
}

}  // namespace stereonav
