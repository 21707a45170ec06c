// A height field as a thin volume (Kniss et al. 2003, section 3.4; row K7 of docs/ledger.md): it fills the
// space between two distances from its height, with a taper at both faces, and is read from the mip level
// that suits the footprint of a sample.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "engine/image/color_texture.h"
#include "engine/image/plane.h"
#include "engine/medium/model/medium_table.h"

namespace stereonav {

struct HeightLayer {
    // Level 0: heights in metres (world z), samples spacing apart, sample (0, 0) at `origin`, columns to +x,
    // rows to +y (north). Level n: means of 2^n x 2^n samples. See makeMipLevels.
    std::vector<Plane<float>> levels;
    double originX = 0, originY = 0, spacing = 1;  // metres
    double below = 1, above = 0;  // metres: the layer extends from height - below to height + above
    double taper = 0;             // metres at both faces, over which extinction falls linearly to 0
    MediumTable table;            // properties by height in metres
    // Colours by place, which multiply the table's. Grid coordinates count from the origin, colorSpacing
    // metres each. Null: no colours.
    std::shared_ptr<const ColorTexture> color;
    glm::dvec2 colorSpacing{1.0};  // metres

    double lowest = 0, highest = 0;  // metres, world z: bounds of all places that are not empty

    // Returns the height at a place from the mip level for that footprint (metres; 0: the finest),
    // interpolated within and between levels; NaN beyond the edge.
    double heightAt(double x, double y, double footprint) const;
    // Returns the linear RGB factor of `color` from the mip level whose texels are as large as the footprint;
    // 1 without a texture.
    glm::vec3 colorAt(double x, double y, double footprint) const;
    double colorTexel() const;  // metres across a texel, the mean of both sides; requires a texture
    OpticalProperties at(const glm::dvec3& world, double footprint) const;
};
// Fills levels 1, 2, .. from level 0, and lowest, highest.
void makeMipLevels(HeightLayer& layer);

}  // namespace stereonav
