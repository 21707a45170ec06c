// How ground lies at its samples, as far as its colours follow it: slope, hollows and ridges, and how wet it
// may be.
//
// The wetness stands in for the topographic index ln(a / tan b) of Beven and Kirkby 1979 (A physically based,
// variable contributing area model of basin hydrology), whose catchment area a would have to be followed over
// the whole ground. Here hollows at two scales (a sample against smoothed heights: the topographic position
// of Weiss 2001) take the place of ln a. tests/terrain/ground_shape_test.cpp holds it against the index.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/ground/heightfield.h"

namespace stereonav {

class GroundShape {
public:
    // Takes a part of the whole, finer than that or not. part must outlive this. unscale: metres of the file
    // for one of the ground's.
    GroundShape(const Heightfield& part, const Heightfield& whole, double unscale);

    // Properties at the samples, interpolated bilinearly; beyond the edge those of the nearest sample count.
    struct Site {
        glm::vec2 gradient{0.0f};  // metres a metre of the ground, as Heightfield::normalAt() has it
        float hollow = 0;          // -1 on ridges to 1 in hollows, of some 10 samples of the whole
        float wet = 0;             // -1 on steep ridges to 1 on valley floors
        float broad = 0;           // noise, -1 to 1, of some 23 samples of the whole and finer
        glm::dvec3 normal() const;
    };
    Site siteAt(const glm::dvec2& grid) const;

    // Turns grid coordinates of the part into those of the whole.
    glm::dvec2 inWhole(const glm::dvec2& grid) const { return mFirst + grid * mStep; }

private:
    // A site as it is kept, in as many bytes as those of GroundTint.
    struct KeptSite {
        glm::vec2 gradient{0.0f};                     // metres per metre of the ground
        std::int16_t hollow = 0, wet = 0, broad = 0;  // times kWhole
    };
    static constexpr float kWhole = 32767;  // steps of a share of 1

public:
    static constexpr double kBytesPerSample = sizeof(KeptSite);

private:
    const Heightfield& mGround;
    glm::dvec2 mFirst{0.0}, mStep{1.0};  // grid of the whole: the first sample, and from one to the next
    std::vector<KeptSite> mSites;
};

}  // namespace stereonav
