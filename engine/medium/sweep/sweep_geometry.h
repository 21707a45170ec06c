// Where the slices of a sweep lie, and how eyes and light look at them: the same for plain code, kernels and
// shaders. Based on half-angle slicing (Kniss et al. 2003, section 3.1 and fig. 3). Differences: the axis
// leans towards the view where a wide frustum would otherwise graze the slices; both eyes share it; positions
// are relative to an anchor near the head, so that large coordinates cost nothing.
//
// A slice is the set of points with dot(axis, p - anchor) = t. The light always travels towards larger t.
// Eyes look towards larger t (forward: their colours gather front to back) or towards smaller t (back to
// front).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/medium/model/medium.h"
#include "engine/medium/model/medium_look.h"
#include "engine/medium/sweep/sweep_setting.h"

namespace stereonav {

// Rays through the pixels (texels) of a buffer. Pixel (x, y)'s centre is (x + 0.5, y + 0.5), y downwards.
// Perspective: origin + k (forward + right * (xMin + x * perX) + up * (yMax - y * perY)), with k from the
// origin on. Parallel: origin + right * (xMin + x * perX) + up * (yMax - y * perY) + k forward.
struct RayFan {
    bool parallel = false;
    glm::dvec3 origin{0.0};                                     // metres, relative to the anchor
    glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // orthonormal
    double xMin = 0, yMax = 0, perX = 0,
           perY = 0;  // at unit distance along forward, or metres where parallel
    int width = 0, height = 0;

    glm::dvec3 start(double x, double y) const;      // a point on the ray
    glm::dvec3 direction(double x, double y) const;  // unit length
    // Returns buffer coordinates of a point; behind a perspective origin: NaN.
    glm::dvec2 project(const glm::dvec3& place) const;
    // Distance of the place from the origin along forward, and the width of a pixel there: metres.
    double depthOf(const glm::dvec3& place) const;
    double pixelSize(const glm::dvec3& place) const;
};

// Rays with a smaller cosine to the axis, or that go against their sweep, cross no slab.
constexpr double kLeastCosine = 1e-4;

// The slices of a sweep, its eyes and its light.
struct SweepGeometry {
    glm::dvec3 anchor{0.0};    // world: the place of the medium's box that is nearest to the head
    glm::dvec3 axis{0, 0, 1};  // unit
    bool forward = true;
    // Metres along the axis: slab k lies between faces[k] and faces[k + 1], sampled at their mean. Ascending,
    // at least two, or none where there is nothing to see. Even over the medium's whole box, so that they
    // stay where they are as one flies, with more faces at eyes and lamp where these are inside: a slab is
    // wholly before or behind them. Slabs that no eye sees, nor light crosses on its way to one that is seen,
    // are left out.
    std::vector<double> faces;
    std::vector<RayFan> eyes;
    // Rays of the light's buffer, which holds the box, or what a lamp's cone meets of it, and where light is
    // scattered also what it may spread to beside the cone; width 0: the model needs none, but the light's
    // place and way are still origin and forward.
    RayFan light;
    // Metres along the axis before which a lamp lights nothing (-infinity for parallel light).
    double lightStart = 0;
    glm::vec3 radiance{1.0f};  // the light's, linear RGB
    double falloff = 0;        // metres, MediumLight's
    double lampCosine = -1;    // cosine of half the lamp's cone
    // How far V11 counts for scattered light, 0..1: from 50 to 75 degrees between view and light.
    double leaning = 0;

    int slabs() const { return faces.empty() ? 0 : static_cast<int>(faces.size()) - 1; }
};

// Makes the geometry for one or several eyes at once. Axis: with beta the angle between the light's way and
// the middle view direction (turned round where their dot product is negative), a = clamp((beta + light's
// half angle - eyes' half angle) / 2, 0, beta) from the view towards the light; the paper's half angle where
// both half angles are equal. Eye rays then stay below 85 degrees from the axis for frusta up to 100 degrees
// across the corners; for wide lamps a is lowered to that, though not below (beta - eyes' half angle) / 2.
// Throws Error for settings and lights out of range.
SweepGeometry makeSweepGeometry(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
                                std::span<const EyeView> eyes, const glm::dvec3& head);

// Returns the offset of scattered light's taps over the root of the way (V9), root of metres.
double blurOf(const Medium& medium, const SweepSetting& setting);

// Returns scattered light, 0 to 1, as it sets out, for the buffer and a ring of texels around it, rows of
// light.width + 2 from (-1, -1) on: the part of a texel that lies within the lamp's cone. Returns nothing
// where that is 1 everywhere. The ring stays as it is, and what lies farther outside is like the nearest
// texel of it.
std::vector<float> scatteredAtStart(const SweepGeometry& geometry);

}  // namespace stereonav
