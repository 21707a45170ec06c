// See the header. Rays are traced through a copy of the voxel's surroundings, by the caster that the fast
// ones are tested against: slow, exact, and nothing shared with the estimates but the data.
#include "engine/light/occlusion/occlusion_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/paths/isovalue_surface.h"
#include "engine/math/constants.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

double smallestSpacing(const VolumeFrame& frame) {
    return std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
}

// The digits of n in a base, mirrored at the point (van der Corput).
double mirrored(unsigned n, unsigned base) {
    double value = 0, digit = 1.0 / base;
    for (; n > 0; n /= base, digit /= base) value += digit * (n % base);
    return value;
}

double attenuation(double distance, double radius) {
    const double share = std::min(distance / radius, 1.0);
    return share * share * share;
}

// Any unit vector across another.
glm::dvec3 across(const glm::dvec3& normal) {
    const glm::dvec3 other = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    return glm::normalize(glm::cross(other, normal));
}

// The voxels within `radius` (and two more) around one, the denser side up: stored numbers, or minus one
// minus them. At least two along each axis where the volume has them.
struct Surroundings {
    GreyVolume part;
    glm::ivec3 voxel{0};  // in it

    Surroundings(const GreyVolume& volume, const glm::ivec3& middle, double radius) {
        const VolumeFrame& frame = volume.frame;
        const glm::dvec3 exact = glm::min(glm::ceil(radius / frame.spacing) + 2.0, glm::dvec3(frame.size));
        const glm::ivec3 reach(exact), first = glm::max(middle - reach, 0);
        const glm::ivec3 extent = glm::min(middle + reach, frame.size - 1) - first + 1;
        voxel = middle - first;
        part = GreyVolume(frame.cropped(first, extent));
        for (int k = 0; k < extent.z; ++k)
            for (int j = 0; j < extent.y; ++j)
                for (int i = 0; i < extent.x; ++i) {
                    const std::int16_t value = volume.at(first + glm::ivec3(i, j, k));
                    part.at(i, j, k) = volume.scale < 0 ? static_cast<std::int16_t>(-1 - value) : value;
                }
    }
    // The isovalue that the baked light takes: at the least value a little more.
    double isovalue() const {
        const std::int16_t* values = part.values.data();
        return tracedIsovalue(part.at(voxel), *std::min_element(values, values + part.values.size()));
    }
};

struct HemispherePoint {
    glm::dvec3 normal, tangent, other;
    explicit HemispherePoint(const glm::dvec3& n)
        : normal(n), tangent(across(n)), other(glm::cross(n, tangent)) {}
    // Returns a direction, with a density that goes with the cosine.
    glm::dvec3 at(double u, double v) const {
        const double radius = std::sqrt(u), angle = 2 * kPi * v;
        return radius * (std::cos(angle) * tangent + std::sin(angle) * other) + std::sqrt(1 - u) * normal;
    }
};

void traceRays(const Surroundings& around, double isovalue, const glm::dvec3& place, const glm::dvec3& normal,
               double radius, int directions, TracedOpenness& result) {
    const HemispherePoint hemisphere(normal);
    const glm::dvec3 start = around.part.frame.worldFromVoxel(
        liftedStart(around.part, isovalue, glm::dvec3(around.voxel), normal));
    double attenuated = 0, visible = 0;
    for (int n = 0; n < directions; ++n) {
        const glm::dvec3 direction =
            hemisphere.at((n + 0.5) / directions, mirrored(static_cast<unsigned>(n), 2));
        const PlainHit hit = castPlainVolume(around.part, isovalue, {start, direction, 0});
        const double distance = hit.hit() ? glm::length(start + hit.t * direction - place)
                                          : std::numeric_limits<double>::infinity();
        attenuated += attenuation(distance, radius);
        visible += distance > radius ? 1 : 0;
    }
    result.obscurance = attenuated / directions;
    result.visible = visible / directions;
}

bool within(const VolumeFrame& frame, const glm::dvec3& voxel) {
    const glm::dvec3 last(frame.size - 1);
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x <= last.x && voxel.y <= last.y &&
           voxel.z <= last.z;
}

double probeSphere(const Surroundings& around, double isovalue, const glm::dvec3& place,
                   const glm::dvec3& normal, double radius, int points) {
    const glm::dvec3 centre = place + 0.5 * radius * normal;
    int open = 0;
    for (int n = 0; n < points; ++n) {
        const auto index = static_cast<unsigned>(n);
        const double z = 1 - 2 * mirrored(index, 2), angle = 2 * kPi * mirrored(index, 3);
        const double away = 0.5 * radius * std::cbrt((n + 0.5) / points), flat = std::sqrt(1 - z * z);
        const glm::dvec3 direction(flat * std::cos(angle), flat * std::sin(angle), z);
        const glm::dvec3 voxel = around.part.frame.voxelFromWorld(centre + away * direction);
        open += !within(around.part.frame, voxel) || plainValue(around.part, voxel) < isovalue;
    }
    return static_cast<double>(open) / points;
}

void checkInput(const glm::ivec3& size, double radius) {
    if (!(radius > 0 && std::isfinite(radius)))
        throw Error("", "occlusion radius", fmt::format("expected metres above 0, got {}", radius),
                    "choose a larger one");
    if (size.x < 2 || size.y < 2 || size.z < 2)
        throw Error("", "occlusion",
                    fmt::format("expected a volume of at least 2 voxels along each axis, got {}x{}x{}",
                                size.x, size.y, size.z),
                    "use a method that needs no rays");
}

std::array<glm::dvec3, 42> makeDirections() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    std::vector<glm::dvec3> vertices;
    for (int axis = 0; axis < 3; ++axis)
        for (int n = 0; n < 4; ++n) {
            glm::dvec3 v(0.0);
            v[(axis + 1) % 3] = n & 1 ? 1 : -1;
            v[(axis + 2) % 3] = n & 2 ? golden : -golden;
            vertices.push_back(v);
        }
    std::array<glm::dvec3, 42> directions{};
    std::size_t count = 0;
    for (std::size_t a = 0; a < vertices.size(); ++a) {
        directions[count++] = glm::normalize(vertices[a]);
        for (std::size_t b = 0; b < a; ++b)  // edges are 2 long, other pairs longer
            if (glm::distance(vertices[a], vertices[b]) < 2.1)
                directions[count++] = glm::normalize(vertices[a] + vertices[b]);
    }
    return directions;
}

}  // namespace

TracedOpenness traceOpenness(const GreyVolume& volume, const glm::ivec3& voxel, double radius,
                             int directions) {
    checkInput(volume.frame.size, radius);
    TracedOpenness result;
    const Surroundings around(volume, voxel, radius);
    const glm::dvec3 normal = surfaceNormal(around.part, glm::dvec3(around.voxel));
    if (normal == glm::dvec3(0.0)) return result;
    const double isovalue = around.isovalue();
    const glm::dvec3 place = volume.frame.worldFromVoxel(glm::dvec3(voxel));
    result.surface = true;
    traceRays(around, isovalue, place, normal, radius, directions, result);
    result.sphere = probeSphere(around, isovalue, place, normal, radius, 8 * directions);
    return result;
}

const std::array<glm::dvec3, 42>& occlusionDirections() {
    static const std::array<glm::dvec3, 42> directions = makeDirections();
    return directions;
}

double opennessByDirections(const GreyVolume& volume, const glm::ivec3& voxel, DirectionMethod method,
                            double radius) {
    checkInput(volume.frame.size, radius);
    const VolumeFrame& frame = volume.frame;
    const double step = smallestSpacing(frame), sign = volume.scale < 0 ? -1 : 1;
    const glm::dvec3 normal = sign * surfaceNormal(volume, glm::dvec3(voxel));
    const double own = sign * volume.at(voxel);
    double open = 0, all = 0;
    for (const glm::dvec3& direction : occlusionDirections()) {
        const double weight = normal == glm::dvec3(0.0) ? 1.0 : glm::dot(direction, normal);
        if (!(weight > 0)) continue;
        all += weight;
        const glm::dvec3 by = frame.voxelDirection(direction);
        double share = 1;
        for (int n = 1; n * step <= radius * (1 + 1e-9); ++n) {
            const glm::dvec3 at = glm::dvec3(voxel) + n * step * by;
            if (!within(frame, at)) break;
            if (!(sign * plainValue(volume, at) > own)) continue;
            share = method == DirectionMethod::Vicinity ? 0 : attenuation(n * step, radius);
            break;
        }
        open += weight * share;
    }
    return open / all;
}

OpennessVolume opennessByDirections(const GreyVolume& volume, DirectionMethod method, double radius,
                                    Progress& progress) {
    const glm::ivec3 size = volume.frame.size;
    checkInput(size, radius);
    OpennessVolume openness(volume.frame);
    progress.report(0, "occlusion");
    parallelFor(size.z * size.y, [&](int row) {
        if (progress.cancelled()) throw Cancelled();
        const int j = row % size.y, k = row / size.y;
        for (int i = 0; i < size.x; ++i)
            openness.at(i, j, k) = static_cast<std::uint8_t>(
                std::lround(255 * opennessByDirections(volume, {i, j, k}, method, radius)));
    });
    progress.report(1, "occlusion");
    return openness;
}

}  // namespace stereonav
