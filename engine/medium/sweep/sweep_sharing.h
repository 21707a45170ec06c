// What two eyes side by side have in common: in a slab, the part of a plane across the sweep's axis, the left
// eye sees along a row of its pixels what the right eye sees in the same row, shifted. Where pixels are fine
// enough beside the medium the right eye reads what the left one saw there.
#pragma once

#include "engine/medium/model/medium.h"
#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/medium/sweep/sweep_kernel_types.h"

namespace stereonav {

// Returns the width of what is told apart in a medium: the least of a voxel, a texel of noise that does
// something, a sample of a height layer, its taper or a texel of its colours. Metres; 0 where a layer has
// sharp faces, infinite where nothing is.
double finestDetail(const Medium& medium);

class SweepSharing {
public:
    SweepSharing() = default;  // nothing is shared
    // widestPixel: metres; in slabs where pixels are wider nothing is shared. Nothing at all but between two
    // eyes with the same axes and size of picture, which lie beside each other along their rows.
    SweepSharing(const SweepGeometry& geometry, const WorldBox& box, double widestPixel);

    bool any() const { return mAny; }
    // Returns which slabs of a chunk are shared, as bits, and where the second eye finds in them what the
    // first saw.
    std::uint32_t slabsOf(const SweepChunk& chunk, int count, SharedRows& rows) const;

private:
    bool share(double away, double& parallax) const;

    bool mAny = false;
    bool mForward = true;
    double mSeparation = 0;               // metres between the eyes along `right`
    double mStart = 0, mAxisRight = 0;    // metres: the second eye along the axis; right . axis
    double mCosines[4] = {};              // axis . rays of depth 1 through the picture's corners
    double mNearest = 0, mFarthest = 0;   // metres: depths of the medium's box
    double mPixel = 0, mWidestPixel = 0;  // at depth 1; metres
    float mColumn = 0;                    // SharedRows::column, pixels
    int mWidth = 0;
};

}  // namespace stereonav
