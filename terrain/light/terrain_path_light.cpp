#include "terrain/light/terrain_path_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/luminance.h"

namespace stereonav {
namespace {

constexpr int kSize = RayPacket::kSize;

class Random {
public:
    explicit Random(std::uint64_t seed) : mState(seed) {}
    double next() {  // splitmix64
        std::uint64_t x = mState += 0x9e3779b97f4a7c15ull;
        x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
        x = (x ^ x >> 27) * 0x94d049bb133111ebull;
        return static_cast<double>((x ^ x >> 31) >> 11) * 0x1p-53;
    }

private:
    std::uint64_t mState;
};

// Returns a direction around a unit axis: `cosine` along it, `turn` about it.
glm::dvec3 around(const glm::dvec3& axis, double cosine, double turn) {
    const glm::dvec3 beside = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(beside, axis)), v = glm::cross(axis, u);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return cosine * axis + sine * (std::cos(turn) * u + std::sin(turn) * v);
}

// Sixteen paths side by side.
class Paths {
public:
    Paths(const GroundRays& rays, const SunAndSky& light,
          const std::function<glm::vec3(const glm::dvec3&)>& sky, const PathLightSetting& setting,
          Random& random)
        : mRays(rays), mLight(light), mSky(sky), mSetting(setting), mRandom(random) {}

    void trace(const glm::dvec2& place) {
        std::fill_n(mSum, kSize, glm::dvec3(0.0));
        for (int k = 0; k < kSize; ++k) settle(k, place);
        std::uint32_t alive = (1u << kSize) - 1;
        double weight = 1;
        for (int b = 0; b <= mSetting.bounces && alive; ++b, weight *= mSetting.albedo) {
            addSun(alive, weight);
            alive = goOn(alive, weight);
        }
    }
    const glm::dvec3& sum(int k) const { return mSum[k]; }

private:
    void settle(int k, const glm::dvec2& place) {
        const Heightfield& ground = mRays.ground();
        mPlace[k] = glm::dvec3(place, mRays.heightAt(place) - mRays.centreHeight() + mRays.lift());
        mNormal[k] = ground.normalAt(place);
    }

    void aim(RayPacket& packet, int k, const glm::dvec3& direction) const {
        packet.originX[k] = static_cast<float>(mPlace[k].x);
        packet.originY[k] = static_cast<float>(mPlace[k].y);
        packet.originZ[k] = static_cast<float>(mPlace[k].z);
        packet.directionX[k] = static_cast<float>(direction.x);
        packet.directionY[k] = static_cast<float>(direction.y);
        packet.directionZ[k] = static_cast<float>(direction.z);
    }

    void addSun(std::uint32_t alive, double weight) {
        const double cosine = std::cos(mLight.sunRadius);
        RayPacket packet{};
        glm::dvec3 towards[kSize];
        std::uint32_t lit = 0;
        for (int k = 0; k < kSize; ++k) {
            towards[k] = around(mLight.toSun, 1 - (1 - cosine) * mRandom.next(),
                                2 * std::numbers::pi * mRandom.next());
            aim(packet, k, towards[k]);
            if ((alive >> k & 1) && towards[k].z > 0 && glm::dot(towards[k], mNormal[k]) > 0) lit |= 1u << k;
        }
        if (lit) lit &= ~mRays.occluded(packet, lit);
        for (int k = 0; k < kSize; ++k)
            if (lit >> k & 1) mSum[k] += weight * glm::dot(towards[k], mNormal[k]) * glm::dvec3(mLight.sun);
    }

    // One cosine-distributed step of each path; the bits of those that met ground.
    std::uint32_t goOn(std::uint32_t alive, double weight) {
        RayPacket packet{};
        glm::dvec3 direction[kSize];
        for (int k = 0; k < kSize; ++k) {
            direction[k] =
                around(mNormal[k], std::sqrt(1 - mRandom.next()), 2 * std::numbers::pi * mRandom.next());
            aim(packet, k, direction[k]);
        }
        mRays.intersect(packet, alive);
        std::uint32_t hit = 0;
        for (int k = 0; k < kSize; ++k) {
            if (!(alive >> k & 1)) continue;
            if (std::isfinite(packet.distance[k])) {
                settle(k, glm::dvec2(mPlace[k]) + double(packet.distance[k]) * glm::dvec2(direction[k]));
                hit |= 1u << k;
            } else if (direction[k].z > 0) {
                mSum[k] += weight * glm::dvec3(mSky(direction[k]));
            }
        }
        return hit;
    }

    const GroundRays& mRays;
    const SunAndSky& mLight;
    const std::function<glm::vec3(const glm::dvec3&)>& mSky;
    const PathLightSetting& mSetting;
    Random& mRandom;
    glm::dvec3 mPlace[kSize], mNormal[kSize], mSum[kSize];
};

}  // namespace

PathLight tracePathLight(const GroundRays& rays, const glm::dvec2& place, const SunAndSky& light,
                         const std::function<glm::vec3(const glm::dvec3&)>& sky,
                         const PathLightSetting& setting) {
    Random random(setting.seed);
    Paths paths(rays, light, sky, setting, random);
    PathLight result;
    double square = 0;
    for (int first = 0; first < setting.paths; first += kSize) {
        paths.trace(place);
        for (int k = 0; k < kSize; ++k) {
            result.mean += paths.sum(k) / double(setting.paths);
            square += std::pow(luminance(paths.sum(k)), 2) / setting.paths;
        }
    }
    const double mean = luminance(result.mean);
    result.variance = std::max(0.0, square - mean * mean) / std::max(1, setting.paths - 1);
    return result;
}

}  // namespace stereonav
