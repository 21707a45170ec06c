// Detail below the sample spacing: a fractal relief that tilts the ground's normal for its shading and does
// nothing else. Silhouette, depth and colours' mean stay. It is a sum of octaves of value noise, each turned
// and sqrt(5) times finer than the one before, whose lattices are the Gaussian integers' multiples of (2 +
// i)^k: whole numbers in the ground's grid, so that a place far from the origin is as exact as one near it.
// An octave fades out as a pixel's longer side on the ground comes from a third of a cell of its lattice to
// two thirds.
//
// Two kinds. Rough: octaves are about equally steep, and value noise between whole numbers is level at each,
// which shows as a weave near the eye. Weathered: gradient noise, kept as a map of slopes that are
// interpolated themselves, so that no lattice shows; slopes fall by kWeatheredFlatter from octave to octave,
// as of ground that is covered by soil and debris, and each octave has a little tone of its own.
#pragma once

#include <vector>

#include "terrain/cast/caster_types.h"
#include "terrain/ground/heightfield.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

class GroundDetail {
public:
    // Takes half a second for a hundred million samples on two threads.
    enum class Kind { Rough, Weathered };
    explicit GroundDetail(const Heightfield& ground, Kind kind = Kind::Rough);

    // Returns the detail in the kernels' form, under the look's sun; must not outlive this object.
    DetailData forKernels(const TerrainLook& look) const;
    std::size_t byteCount() const { return 4 * (mValues.size() + mRelief.size() + mRough.size()); }

    // RMS slope that all octaves together have on the steepest ground, metres a metre.
    double rmsSlope() const;

private:
    void makeRelief();

    Kind mKind;
    std::vector<std::uint32_t> mRelief;    // the map of weathered relief, kReliefPitch a row
    double mSlopeUnit = 1, mToneUnit = 1;  // rms of the map's slopes and tones, steps of their bits
    std::vector<float> mValues;            // values of the lattice, -1 to 1, kDetailPitch a row
    std::vector<float> mRough;             // at samples: 0 on level ground, towards 1 on steep ground
    glm::dvec2 mSpacing;                   // metres between samples
    int mWidth;                            // samples of a row
};

}  // namespace stereonav
