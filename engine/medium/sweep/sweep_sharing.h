// Shares samples between two eyes that lie side by side. In a slab, the part of a plane across the sweep's
// axis, the right eye sees in a row of pixels what the left eye sees in the same row, shifted by the
// parallax. In slabs where pixels are fine compared with the medium, the right eye reads what the left eye
// stored.
#pragma once

#include "engine/medium/model/medium.h"
#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/medium/sweep/sweep_kernel_types.h"

namespace stereonav {

// Returns the width in metres of a medium's finest detail: the least of its voxels, the texels of noise that
// has an effect, and the sample spacing, taper and colour texels of its height layers. 0 where a layer has
// sharp faces (no taper); infinite for a medium without any of these.
double finestDetail(const Medium& medium);

class SweepSharing {
public:
    SweepSharing() = default;  // nothing is shared
    // widestPixel: metres; slabs in which a pixel is wider are not shared. Shares nothing unless there are
    // two eyes with the same axes and picture size, beside each other along their rows.
    SweepSharing(const SweepGeometry& geometry, const WorldBox& box, double widestPixel);

    bool any() const { return mAny; }
    // Returns the shared ones among the first `count` slabs of a chunk, as bits. rows: set to where the
    // second eye finds in each of them what the first eye saw.
    std::uint32_t slabsOf(const SweepChunk& chunk, int count, SharedRows& rows) const;

private:
    bool share(double away, double& parallax) const;

    bool mAny = false;
    bool mForward = true;
    double mSeparation = 0;  // metres between the eyes along `right`
    // Metres: the second eye's place along the axis; cosine between `right` and the axis.
    double mStart = 0, mAxisRight = 0;
    double mCosines[4] = {};              // axis . rays of depth 1 through the picture's corners
    double mNearest = 0, mFarthest = 0;   // metres: depths of the medium's box
    double mPixel = 0, mWidestPixel = 0;  // width of a pixel at depth 1; widest pixel that is shared, metres
    float mColumn = 0;                    // SharedRows::column, pixels
    int mWidth = 0;
};

}  // namespace stereonav
