// Detail below the sample spacing: a fractal relief that tilts the ground's normal for shading. Silhouette,
// depth and mean colour stay. It is a sum of octaves of value noise, each rotated and sqrt(5) times finer
// than the one before. Their lattices are the multiples of (2 + i)^k among the Gaussian integers: whole
// numbers in the ground's grid, so that places far from the origin are as exact as near ones. An octave fades
// out as the longer side of a pixel on the ground grows from a third to two thirds of a cell of its lattice.
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

    // Returns the detail in the kernels' form, under the look's sun; must not outlive this object.
    DetailData forKernels(const TerrainLook& look) const;
    std::size_t byteCount() const { return sizeof(float) * (mValues.size() + mRough.size()); }

private:
    std::vector<float> mValues;  // values of the lattice, -1 to 1, kDetailPitch a row
    std::vector<float> mRough;   // at samples: 0 on level ground, towards 1 on steep ground
    glm::dvec2 mSpacing;         // metres between samples
    int mWidth;                  // samples of a row
};

}  // namespace stereonav
