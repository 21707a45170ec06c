// The caster that the fast ones are tested against: double precision, one ray, every cell or sample on the
// way visited, no leaping, nothing shared with the fast code but the data.
//
// A ray is eye + t * direction in world space; with EyeView::rayDirection, t is the view depth.
#pragma once

#include <glm/vec3.hpp>
#include <limits>

#include "engine/volume/volume.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

struct PlainRay {
    glm::dvec3 eye{0.0};        // world, metres
    glm::dvec3 direction{0.0};  // world, any length > 0
    double nearDepth = 0;       // t from which on the ray counts
};

// The first place where a ray meets the surface.
struct PlainHit {
    double t = std::numeric_limits<double>::infinity();  // PlainRay's t; infinity: nothing hit
    glm::ivec3 cell{0};
    glm::dvec3 local{0.0};  // where in the cell, each in [0, 1]
    bool hit() const { return t < std::numeric_limits<double>::infinity(); }
    glm::dvec3 voxel() const { return glm::dvec3(cell) + local; }
};

// Returns the trilinear value in stored numbers at a point of voxel space within [0, size - 1].
double plainValue(const GreyVolume& volume, const glm::dvec3& voxel);

// Returns the first s in [0, 1] where the trilinear value is >= isovalue at from + s * step, both ends in the
// cell: places in it, each in [0, 1]. Infinity where it nowhere is.
double firstInCell(const GreyVolume& volume, double isovalue, const glm::ivec3& cell, const glm::dvec3& from,
                   const glm::dvec3& step);

// Finds the first t >= nearDepth within the volume where the trilinear value is >= isovalue (stored numbers):
// where the ray enters a cell if it is so there already, else the first root of the cell's cubic (Parker et
// al. 1998), isolated by the roots of its derivative and bisected, so that tangent rays are decided too.
PlainHit castPlainVolume(const GreyVolume& volume, double isovalue, const PlainRay& ray);

// Returns the normal that shading uses at a point of voxel space, unit, world: corner normals (minus the
// smoothed gradient, unit length, 0 where it tells no side: kOneSided), trilinear between the cell's corners.
// Where the corners do not agree, as in flesh thinner than a voxel, each counts by how far it follows the
// slope of the trilinear values, turned around where it is against it: the normal is that of the side where
// the values fall. +z where there is no slope.
glm::dvec3 plainNormal(const GreyVolume& volume, const glm::dvec3& voxel);

// Returns light from `position` to the eye, linear RGB. Blinn-Phong with the lamp at the head: l leads from
// the position to the head, h halves l and the direction to the eye;
// falling off * (albedo * (ambient * (1 + varyingAmbient * n.z) + diffuse * max(n.l, 0)) + specular *
// max(n.h, 0)^shininess), no highlight where n.l <= 0. position, head, eye: world, metres. normal: unit,
// towards smaller values; it is not flipped.
glm::dvec3 shadePlain(const VolumeLook& look, const glm::dvec3& position, const glm::dvec3& normal,
                      const glm::dvec3& head, const glm::dvec3& eye, const glm::dvec3& albedo);

}  // namespace stereonav
