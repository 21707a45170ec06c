// A height field as a thin volume (Kniss et al. 2003, section 3.4; row K7): opaque between two distances from
// its height, tapered at both faces, from mip levels that suit the footprint of a sample.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/plane.h"
#include "engine/medium/medium_table.h"

namespace stereonav {

struct HeightLayer {
    // Level 0: heights in metres (world z), samples spacing apart, sample (0, 0) at `origin`, columns to +x,
    // rows to +y (north). Level n: means of 2^n x 2^n samples. See makeMipLevels.
    std::vector<Plane<float>> levels;
    double originX = 0, originY = 0, spacing = 1;  // metres
    double below = 1, above = 0;  // metres: the layer reaches from height - below to height + above
    double taper = 0;             // metres at both faces over which extinction falls to 0 linearly
    MediumTable table;            // over the height in metres

    double lowest = 0, highest = 0;  // of what is not empty, world z

    // Height at a place by the level of that footprint (metres; 0: the finest), linear within and between
    // levels; beyond the edge there is none: NaN.
    double heightAt(double x, double y, double footprint) const;
    OpticalProperties at(const glm::dvec3& world, double footprint) const;
};
// Fills levels 1, 2, .. of level 0 and lowest, highest.
void makeMipLevels(HeightLayer& layer);

}  // namespace stereonav
