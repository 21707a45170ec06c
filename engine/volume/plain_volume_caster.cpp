// See the header. Cells are walked as Amanatides and Woo 1987 do, but every crossing is computed from the
// cell's integer bounds instead of summed up, so that errors do not grow along the ray.
#include "engine/volume/plain_volume_caster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/math/constants.h"
#include "engine/volume/surface_cells.h"
#include "engine/volume/volume_kernel_types.h"

namespace stereonav {
namespace {

using Corners = std::array<double, 8>;  // at x + 2 y + 4 z

glm::ivec3 cornerOffset(int n) {
    return {n & 1, n >> 1 & 1, n >> 2};
}

Corners cornersOf(const GreyVolume& volume, const glm::ivec3& cell) {
    Corners c;
    for (int n = 0; n < 8; ++n) c[n] = volume.at(cell + cornerOffset(n));
    return c;
}

// a where s is 0 and b where s is 1, exactly.
double mix(double a, double b, double s) {
    return a * (1 - s) + b * s;
}

double trilinear(const Corners& c, const glm::dvec3& p) {
    const double y0 = mix(mix(c[0], c[1], p.x), mix(c[2], c[3], p.x), p.y);
    const double y1 = mix(mix(c[4], c[5], p.x), mix(c[6], c[7], p.x), p.y);
    return mix(y0, y1, p.z);
}

// Cubic in s, lowest power first.
struct Cubic {
    std::array<double, 4> a{};
    double at(double s) const { return ((a[3] * s + a[2]) * s + a[1]) * s + a[0]; }
};

// q += p * (a + b s)
void addProduct(Cubic& q, const Cubic& p, double a, double b) {
    for (int n = 0; n < 4; ++n) q.a[n] += p.a[n] * a;
    for (int n = 0; n < 3; ++n) q.a[n + 1] += p.a[n] * b;
}

// The values along from + s * step, s in [0, 1], minus the isovalue: one linear mix an axis.
Cubic alongRay(const Corners& corners, double isovalue, const glm::dvec3& from, const glm::dvec3& step) {
    std::array<Cubic, 8> level;
    for (int n = 0; n < 8; ++n) level[n].a[0] = corners[n] - isovalue;
    std::size_t count = 4;
    for (int axis = 0; axis < 3; ++axis, count /= 2)
        for (std::size_t n = 0; n < count; ++n) {
            Cubic mixed;
            addProduct(mixed, level[2 * n], 1 - from[axis], -step[axis]);
            addProduct(mixed, level[2 * n + 1], from[axis], step[axis]);
            level[n] = mixed;
        }
    return level[0];
}

// Ends of the pieces of (0, 1] in which the cubic is monotonic, ascending; the last is 1.
int monotonicEnds(const Cubic& f, std::array<double, 3>& ends) {
    const double a = 3 * f.a[3], b = 2 * f.a[2], c = f.a[1];
    std::array<double, 2> roots{-1, -1};
    const double discriminant = b * b - 4 * a * c;
    if (discriminant >= 0) {
        const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
        if (a != 0) roots[0] = q / a;
        if (q != 0) roots[1] = c / q;
    }
    std::sort(roots.begin(), roots.end());
    int count = 0;
    for (const double root : roots)
        if (root > 0 && root < 1) ends[count++] = root;
    ends[count++] = 1;
    return count;
}

// The least s found in (low, high] with f(s) >= 0, for f(low) < 0 <= f(high), f rising in between.
double bisect(const Cubic& f, double low, double high) {
    for (;;) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) return high;
        (f.at(middle) < 0 ? low : high) = middle;
    }
}

// First s in [0, 1] with f(s) >= 0, infinity without one.
double firstReached(const Cubic& f) {
    if (f.at(0) >= 0) return 0;
    std::array<double, 3> ends;
    const int count = monotonicEnds(f, ends);
    double low = 0;
    for (int n = 0; n < count; ++n) {
        if (f.at(ends[n]) >= 0) return bisect(f, low, ends[n]);
        low = ends[n];
    }
    return kInfinity;
}

// A ray in voxel space, and the part of it within [0, size - 1].
struct VoxelRay {
    glm::dvec3 origin, direction;
    double begin, end;  // t; begin > end: misses the volume

    VoxelRay(const VolumeFrame& frame, const PlainRay& ray)
        : origin(frame.voxelFromWorld(ray.eye)),
          direction(frame.voxelDirection(ray.direction)),
          begin(ray.nearDepth),
          end(kInfinity) {
        for (int axis = 0; axis < 3; ++axis) clip(axis, frame.size[axis] - 1);
        if (glm::dot(direction, direction) == 0) end = -kInfinity;  // no ray
    }
    glm::dvec3 at(double t) const { return origin + t * direction; }

private:
    void clip(int axis, double last) {
        if (direction[axis] == 0) {
            if (!(origin[axis] >= 0 && origin[axis] <= last)) end = -kInfinity;
            return;
        }
        const double a = -origin[axis] / direction[axis], b = (last - origin[axis]) / direction[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
};

glm::ivec3 cellOf(const VolumeFrame& frame, const glm::dvec3& voxel) {
    return glm::ivec3(
        glm::clamp(glm::floor(voxel), glm::dvec3(0.0), glm::max(glm::dvec3(frame.size - 2), 0.0)));
}

// Where the ray leaves the cell, and along which axis.
struct Exit {
    double t = kInfinity;
    int axis = 0;
};

Exit exitOf(const VoxelRay& ray, const glm::ivec3& cell) {
    Exit exit;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) continue;
        const double bound = cell[axis] + (ray.direction[axis] > 0 ? 1 : 0);
        const double t = (bound - ray.origin[axis]) / ray.direction[axis];
        if (t < exit.t) exit = {t, axis};
    }
    return exit;
}

PlainHit hitInCell(const GreyVolume& volume, double isovalue, const VoxelRay& ray, const glm::ivec3& cell,
                   double begin, double end) {
    const auto local = [&](double t) {
        return glm::clamp(ray.at(t) - glm::dvec3(cell), glm::dvec3(0.0), glm::dvec3(1.0));
    };
    const glm::dvec3 from = local(begin), step = local(end) - from;
    const double s = firstInCell(volume, isovalue, cell, from, step);
    if (s == kInfinity) return {};
    return {begin + s * (end - begin), cell, from + s * step};
}

// How much values change from voxel to voxel around one, stored numbers a metre, weighted as the tricubic
// B-spline's gradient is.
double changeAround(const GreyVolume& volume, const glm::ivec3& at) {
    const auto value = [&](const glm::ivec3& v) {
        return static_cast<double>(volume.at(glm::clamp(v, glm::ivec3(0), volume.frame.size - 1)));
    };
    glm::dvec3 change(0.0);
    for (int axis = 0; axis < 3; ++axis)
        for (int b = -1; b <= 1; ++b)
            for (int c = -1; c <= 1; ++c) {
                glm::ivec3 here = at, step(0);
                here[(axis + 1) % 3] += b, here[(axis + 2) % 3] += c, step[axis] = 1;
                const double weight = (b ? 1 : 4) * (c ? 1 : 4) / 36.0;
                change[axis] +=
                    0.5 * weight *
                    (std::abs(value(here + step) - value(here)) + std::abs(value(here) - value(here - step)));
            }
    return glm::length(change / volume.frame.spacing);
}

// The corners' normals are those of records, which are kept to 10 bits a channel; here they are exact. 0
// where there is none.
glm::dvec3 cornerNormal(const GreyVolume& volume, const glm::ivec3& corner) {
    const glm::dvec3 down = -smoothGradient(volume, glm::dvec3(corner));
    const double length = glm::length(down);
    const glm::dvec3 spacing = volume.frame.spacing;
    // Stored numbers are whole: what is not 0 is a 72nd of a step a voxel at least, what is less is rounding.
    const double least = 1e-6 / std::max({spacing.x, spacing.y, spacing.z});
    return length > least && length >= kOneSided * changeAround(volume, corner) ? down / length
                                                                                : glm::dvec3(0.0);
}

// Towards smaller trilinear values, unit world; 0 where they are all the same.
glm::dvec3 downOf(const VolumeFrame& frame, const Corners& corners, const glm::dvec3& p) {
    glm::dvec3 slope(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 low = p, high = p;
        low[axis] = 0, high[axis] = 1;
        slope[axis] = trilinear(corners, high) - trilinear(corners, low);
    }
    const glm::dvec3 down = -(frame.axes * (slope / frame.spacing));
    return glm::length(slope) > 1e-6 ? glm::normalize(down) : glm::dvec3(0.0);
}

}  // namespace

double plainValue(const GreyVolume& volume, const glm::dvec3& voxel) {
    const glm::ivec3 cell = cellOf(volume.frame, voxel);
    return trilinear(cornersOf(volume, cell), voxel - glm::dvec3(cell));
}

double firstInCell(const GreyVolume& volume, double isovalue, const glm::ivec3& cell, const glm::dvec3& from,
                   const glm::dvec3& step) {
    const Corners corners = cornersOf(volume, cell);
    // What is interpolated between the corners nowhere exceeds the largest of them.
    if (*std::max_element(corners.begin(), corners.end()) < isovalue) return kInfinity;
    return firstReached(alongRay(corners, isovalue, from, step));
}

PlainHit castPlainVolume(const GreyVolume& volume, double isovalue, const PlainRay& worldRay) {
    const glm::ivec3 size = volume.frame.size;
    if (size.x < 2 || size.y < 2 || size.z < 2) return {};
    const VoxelRay ray(volume.frame, worldRay);
    if (!(ray.begin <= ray.end)) return {};
    glm::ivec3 cell = cellOf(volume.frame, ray.at(ray.begin));
    double begin = ray.begin;
    for (;;) {
        const Exit exit = exitOf(ray, cell);
        const double end = std::clamp(exit.t, begin, std::max(begin, ray.end));
        const PlainHit hit = hitInCell(volume, isovalue, ray, cell, begin, end);
        if (hit.hit()) return hit;
        if (exit.t == kInfinity) return {};
        cell[exit.axis] += ray.direction[exit.axis] > 0 ? 1 : -1;
        if (cell[exit.axis] < 0 || cell[exit.axis] > size[exit.axis] - 2) return {};
        begin = end;
    }
}

glm::dvec3 plainNormal(const GreyVolume& volume, const glm::dvec3& voxel) {
    const glm::ivec3 cell = cellOf(volume.frame, voxel);
    const glm::dvec3 p = voxel - glm::dvec3(cell);
    const glm::dvec3 down = downOf(volume.frame, cornersOf(volume, cell), p);
    glm::dvec3 mean(0.0), even(0.0), sum = static_cast<double>(kLeastOfSlope) * down;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 o = cornerOffset(n);
        const double weight = (o.x ? p.x : 1 - p.x) * (o.y ? p.y : 1 - p.y) * (o.z ? p.z : 1 - p.z);
        const glm::dvec3 normal = cornerNormal(volume, cell + o);
        mean += weight * normal;
        even += normal / 8.0;
        sum += weight * glm::dot(normal, down) * normal;
    }
    const double agree = std::min(glm::dot(even, even), glm::dot(mean, mean)),
                 apart = static_cast<double>(kApart);
    const double length = glm::length(mean);
    double share = std::clamp((agree - apart) / (static_cast<double>(kAgree) - apart), 0.0, 1.0);
    if (share < 1) share *= std::clamp(static_cast<double>(kOtherSide) * glm::dot(mean, down), 0.0, 1.0);
    if (agree >= static_cast<double>(kAgree)) return length > 0 ? mean / length : glm::dvec3(0, 0, 1);
    if (!(glm::length(sum) > 0)) return glm::dvec3(0, 0, 1);
    const glm::dvec3 bySlope = glm::normalize(sum);
    return share > 0 ? glm::normalize((1 - share) * bySlope + share * mean / length) : bySlope;
}

glm::dvec3 shadePlain(const VolumeLook& look, const glm::dvec3& position, const glm::dvec3& normal,
                      const glm::dvec3& head, const glm::dvec3& eye, const glm::dvec3& albedo) {
    const double ambient = look.ambient * (1 + look.varyingAmbient * normal.z);
    const glm::dvec3 toHead = head - position, toEye = eye - position;
    const double distance = glm::length(toHead);
    const glm::dvec3 l = distance > 0 ? toHead / distance : glm::dvec3(0.0);
    const double facing = glm::dot(normal, l);
    double highlight = 0;
    if (facing > 0) {
        const double eyeDistance = glm::length(toEye);
        const glm::dvec3 between = l + (eyeDistance > 0 ? toEye / eyeDistance : l);
        const double length = glm::length(between);
        const double cosine = length > 0 ? std::max(glm::dot(normal, between) / length, 0.0) : 0.0;
        highlight = look.specular * std::pow(cosine, static_cast<double>(look.shininess));
    }
    const double ratio = look.falloff > 0 ? distance / look.falloff : 0.0;
    const double light = 1 / (1 + ratio * ratio);
    return light * (albedo * (ambient + look.diffuse * std::max(facing, 0.0)) + highlight);
}

}  // namespace stereonav
