// Measures by which a piece of air is judged: its volume, its density, the tissue around it, its width, a
// place in it.
#pragma once

#include <optional>
#include <vector>

#include "colon/segmentation/lumen_pieces.h"
#include "engine/volume/volume.h"

namespace stereonav {

class AirMeasures {
public:
    // study and air must outlive the object.
    AirMeasures(const GreyVolume& study, const Pieces& air) : mStudy(study), mAir(air) {}

    double volume(int piece) const;  // cubic metres
    // Return whether the piece reaches the scan's sides; its first slice; its last slice.
    bool touchesSides(int piece) const;
    bool touchesFirst(int piece) const;
    bool touchesLast(int piece) const;

    // Metres of tissue to the scan's sides: medians over the piece, without air and metal on the way.
    struct Tissue {
        double right = 0, left = 0, front = 0, back = 0;  // sides of the patient
        // Returns the least of the four, metres.
        double least() const;
        // Returns 0 where the piece lies at a side of the body, 0.5 in the middle.
        double fromSide() const;
    };
    Tissue tissueAround(int piece) const;

    // HU of voxels away from the piece's border, which is partly tissue.
    struct Density {
        double median = 0, high = 0;  // high: a tenth of the voxels is denser
    };
    // Returns the density; nothing where the piece is too thin to have such voxels.
    std::optional<Density> density(int piece) const;

    // The piece taken for a tube.
    struct Tube {
        double diameter = 0;     // metres, mean
        double slenderness = 0;  // length over diameter
    };
    Tube tube(int piece) const;

    glm::dvec3 middle(int piece) const;   // world, metres, of its box
    glm::dvec3 placeIn(int piece) const;  // world, metres: a voxel of it, near its middle

private:
    const Component& part(int piece) const { return mAir.parts.list[static_cast<std::size_t>(piece)]; }
    bool holds(int piece, const glm::ivec3& voxel) const;
    bool within(int piece, const glm::ivec3& voxel, int depth) const;

    const GreyVolume& mStudy;
    const Pieces& mAir;
};

}  // namespace stereonav
