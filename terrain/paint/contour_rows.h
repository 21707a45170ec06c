// Paints contour lines on an eye's picture, row by row, with the kernels of contour_row.h.
#pragma once

#include "engine/simd/simd_target.h"
#include "terrain/paint/contour_painter.h"
#include "terrain/paint/contour_row.h"
#include "terrain/paint/ground_view.h"

namespace stereonav {

class ContourRows {
public:
    // All arguments except target must outlive this object.
    ContourRows(const Heightfield& ground, const Fog& fog, const ContourSetting& setting, const EyeView& view,
                SimdTarget target);

    // Returns whether floats and 32-bit numbers are exact enough: not for ground of more than about 1000
    // million samples, for lines closer than the precision of its heights, or over a round Earth.
    bool fits() const { return mFits; }
    // Paints row y of a finished eye's picture; requires fits().
    void paint(EyeImage& image, int y) const;

private:
    struct Kernels {
        decltype(&plain::findLinePixels) find;
        decltype(&plain::shareOfLines) share;
        decltype(&plain::inkLines) ink;
    };
    static const Kernels& kernelsFor(SimdTarget target);

    void inkThroughFog(const ContourRow& row, int pixels, int y) const;
    void inkPlainly(const ContourRow& row, int x, int y) const;

    const Fog& mFog;
    const EyeView& mView;
    const ContourSetting& mSetting;
    GroundView mGround;
    const Kernels& mKernels;
    ContourRow mRow;  // the part that is the same for all rows
    bool mFits = false;
};

}  // namespace stereonav
