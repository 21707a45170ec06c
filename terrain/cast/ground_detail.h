// Detail below the sample spacing: a fractal relief that tilts the ground's normal for its shading and does
// nothing else. Silhouette, depth and colours' mean stay. It is a sum of octaves of value noise, each turned
// and sqrt(5) times finer than the one before, whose lattices are the Gaussian integers' multiples of (2 +
// i)^k: whole numbers in the ground's grid, so that a place far from the origin is as exact as one near it.
// An octave fades out as a pixel's longer side on the ground comes from a third of a cell of its lattice to
// two thirds.
#pragma once

#include <vector>

#include "terrain/cast/caster_types.h"
#include "terrain/ground/heightfield.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

class GroundDetail {
public:
    // Takes half a second for a hundred million samples on two threads.
    explicit GroundDetail(const Heightfield& ground);

    // Returns what kernels read, under the look's sun; must not outlive this.
    DetailData forKernels(const TerrainLook& look) const;
    std::size_t byteCount() const { return sizeof(float) * (mValues.size() + mRough.size()); }

private:
    std::vector<float> mValues;  // values of the lattice, -1 to 1, kDetailPitch a row
    std::vector<float> mRough;   // at samples: 0 on level ground, towards 1 on steep ground
    glm::dvec2 mSpacing;         // metres between samples
    int mWidth;                  // samples of a row
};

}  // namespace stereonav
