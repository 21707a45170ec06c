// Paths from the eye: at every collision the medium's own glow and the light that reaches the place are
// gathered, then the path goes on as the phase function of one colour says, weighted so that the other
// colours are right as well (balance heuristic over the three: Wilkie et al. 2014).
#include "engine/medium/paths/delta_tracking.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/medium/paths/delta_tracking_flight.h"

namespace stereonav {
namespace {

constexpr double kTurn = 6.283185307179586;
constexpr int kRouletteAfter = 8;  // scatters

float largestOf(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

// The light as paths meet it: where it comes from at a place, and how strong.
class TrackedLight {
public:
    TrackedLight(const MediumLight& light, const EyeView& view)
        : mLight(light),
          mDirection(glm::normalize(light.atHead ? view.forward : light.direction)),
          mPosition(light.atHead ? view.head : light.position),
          mCosine(std::cos(light.coneAngle / 2)) {}

    struct Arrival {
        glm::dvec3 direction;  // the way it travels
        double distance;       // metres that the light travelled; infinite for parallel light
        glm::vec3 radiance;    // R of V4 of docs/volume_light.md
    };
    Arrival at(const glm::dvec3& place) const {
        if (mLight.kind == MediumLight::Kind::Parallel)
            return {mDirection, std::numeric_limits<double>::infinity(), mLight.radiance};
        const glm::dvec3 way = place - mPosition;
        const double distance = glm::length(way);
        if (!(distance > 0)) return {mDirection, 0, mLight.radiance};
        const glm::dvec3 direction = way / distance;
        if (glm::dot(direction, mDirection) < mCosine) return {direction, distance, glm::vec3(0.0f)};
        const double fallen = mLight.falloff > 0 ? distance / mLight.falloff : 0;
        return {direction, distance, mLight.radiance * static_cast<float>(1 / (1 + fallen * fallen))};
    }

private:
    const MediumLight& mLight;
    glm::dvec3 mDirection, mPosition;
    double mCosine;
};

// The direction at an angle to another, turned about it by `turn`. The frame: Duff et al. 2017.
glm::dvec3 turnedAway(const glm::dvec3& w, double cosine, double turn) {
    const double sign = std::copysign(1.0, w.z), a = -1 / (sign + w.z), b = w.x * w.y * a;
    const glm::dvec3 u{1 + sign * w.x * w.x * a, sign * b, -sign * w.x};
    const glm::dvec3 v{b, sign + w.y * w.y * a, -w.y};
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return glm::normalize(sine * (std::cos(turn) * u + std::sin(turn) * v) + cosine * w);
}

class PathTracker {
public:
    PathTracker(const TrackedMedium& medium, const MediumLook& look, const EyeView& view,
                const TrackingSetting& setting)
        : mMedium(medium),
          mLook(look),
          mLight(look.light, view),
          mMostScatters(look.model == MediumModel::Indirect ? setting.mostScatters : 1),
          mOnlyForward(setting.onlyForward) {}

    // Light that comes back along the ray.
    glm::vec3 follow(WorldRay ray, double first, PathRandom& random) const {
        glm::vec3 gathered{0.0f}, carried{1.0f};
        for (int scatters = 1;; ++scatters) {
            const auto met = freeFlight(mMedium, ray, first, random);
            if (!met) return gathered;
            gathered +=
                carried * sentBack(*met, ray.direction, random) * (scatters > 1 ? mLook.indirectShare : 1.0f);
            if (scatters >= mMostScatters) return gathered;
            carried *= met->properties.color;
            ray = {met->place, scattered(ray.direction, carried, random)};
            first = 0;
            if (mOnlyForward && glm::dot(ray.direction, mLight.at(met->place).direction) > 0) return gathered;
            if (!survives(carried, scatters, random)) return gathered;
        }
    }

private:
    // Share of the light at a collision that travels against `direction`.
    glm::vec3 sentBack(const MediumCollision& met, const glm::dvec3& direction, PathRandom& random) const {
        const OpticalProperties& p = met.properties;
        if (mLook.model == MediumModel::Emission) return p.glow + p.color;
        const auto light = mLight.at(met.place);
        const float cosine = static_cast<float>(-glm::dot(light.direction, direction));
        const glm::vec3 sent = p.color * light.radiance * mLook.phase.at(cosine);
        if (largestOf(sent) == 0) return p.glow;
        const WorldRay back{met.place, -light.direction};
        return p.glow + sent * static_cast<float>(transmittance(mMedium, back, 0, light.distance, random));
    }

    // Returns a new direction of the path. carried: multiplied by each colour's phase function over the
    // density with which the direction was chosen.
    glm::dvec3 scattered(const glm::dvec3& direction, glm::vec3& carried, PathRandom& random) const {
        const double turn = kTurn * random.uniform();
        if (mLook.phase.isotropic()) return turnedAway(direction, 1 - 2 * random.uniform(), turn);
        const float sum = carried.x + carried.y + carried.z;
        if (!(sum > 0)) return direction;
        const float choice = random.uniformFloat() * sum;
        const int channel = choice < carried.x ? 0 : choice < carried.x + carried.y ? 1 : 2;
        const float cosine = mLook.phase.sampleCosine(channel, random.uniformFloat());
        const glm::vec3 phase = mLook.phase.at(cosine);
        const float density = glm::dot(carried, phase) / sum;
        carried *= density > 0 ? phase / density : glm::vec3(0.0f);
        return turnedAway(direction, cosine, turn);
    }

    // Russian roulette: a path that carries little light ends by chance, or goes on with more light, so that
    // the mean stays.
    static bool survives(glm::vec3& carried, int scatters, PathRandom& random) {
        const float largest = largestOf(carried);
        if (!(largest > 0)) return false;
        if (scatters < kRouletteAfter || largest >= 1) return true;
        if (random.uniformFloat() >= largest) return false;
        carried /= largest;
        return true;
    }

    const TrackedMedium& mMedium;
    const MediumLook& mLook;
    TrackedLight mLight;
    int mMostScatters;
    bool mOnlyForward;
};

// Sums over a pixel's samples. `seen`, the share of the background, sums estimated transmittances: they are
// less noisy than counting the paths that escape.
struct PixelSums {
    glm::dvec3 light{0.0}, squares{0.0};
    double seen = 0;
    void add(const glm::vec3& sample, double share) {
        const glm::dvec3 value(sample);
        light += value;
        squares += value * value;
        seen += share;
    }
    glm::vec4 mean(int samples) const { return glm::vec4(light / double(samples), seen / samples); }
    glm::vec3 variance(int samples) const {
        const double n = samples;
        if (samples < 2) return glm::vec3(std::numeric_limits<float>::infinity());
        return glm::vec3(glm::max(squares - light * light / n, glm::dvec3(0.0)) / (n * (n - 1)));
    }
};

[[noreturn]] void refuse(const std::string& problem, const std::string& advice) {
    throw Error("", "path tracer", problem, advice);
}

void checkTable(const MediumTable& table) {
    for (const OpticalProperties& entry : table.entries)
        if (entry.surface > 0 && entry.extinction > 0)
            refuse("expected a medium without surfaces, got surface weight " + std::to_string(entry.surface),
                   "use a transfer function with surface 0");
}

void checkSetting(const Medium& medium, const MediumLook& look, const TrackingSetting& setting) {
    if (setting.samples < 1) refuse("expected at least 1 sample, got " + std::to_string(setting.samples), "");
    if (setting.mostScatters < 1)
        refuse("expected at least 1 scatter, got " + std::to_string(setting.mostScatters), "");
    if (look.model == MediumModel::Surface)
        refuse("the surface model has no paths to follow", "use emission, direct or indirect");
    if (medium.field()) checkTable(medium.table());
    for (const HeightLayer& layer : medium.layers()) checkTable(layer.table);
}

}  // namespace

TrackedPicture trackRows(const Medium& medium, const ExtinctionBounds& bounds, const MediumLook& look,
                         const EyeView& view, const TrackingSetting& setting, double time,
                         const PictureRows& rows) {
    checkSetting(medium, look, setting);
    const TrackedMedium tracked{medium, bounds, time};
    const PathTracker paths(tracked, look, view, setting);
    TrackedPicture picture{Plane<glm::vec4>(view.width, view.height),
                           Plane<glm::vec3>(view.width, view.height)};
    const int first = std::max(0, rows.first), end = std::min(view.height, rows.end);
    constexpr int kPixels = 8;  // pixels of a row: few, for paths of some pixels take far longer than others
    const int blocks = (view.width + kPixels - 1) / kPixels;
    parallelFor(std::max(0, end - first) * blocks, [&](int n) {
        const int y = first + n / blocks, begin = n % blocks * kPixels;
        for (int x = begin; x < std::min(view.width, begin + kPixels); ++x) {
            const glm::dvec3 way = view.rayDirection(x + 0.5, y + 0.5);
            const double nearest = view.nearDepth * glm::length(way);
            const WorldRay ray{view.eye, glm::normalize(way)};
            PixelSums sums;
            for (int k = 0; k < setting.samples; ++k) {
                PathRandom random(static_cast<std::uint64_t>(y) * view.width + x, k, setting.seed);
                const glm::vec3 light = paths.follow(ray, nearest, random);
                const double last = std::numeric_limits<double>::infinity();
                sums.add(light, transmittance(tracked, ray, nearest, last, random));
            }
            picture.light.at(x, y) = sums.mean(setting.samples);
            picture.variance.at(x, y) = sums.variance(setting.samples);
        }
    });
    return picture;
}

}  // namespace stereonav
