// Casts scattered pixels of terrain: where holes are dense, as small bands (packets of whole rows, in which
// each ray starts where the one below it permits); elsewhere one by one, each started just in front of a
// known depth.
#pragma once

#include <span>
#include <vector>

#include "engine/image/eye_image.h"
#include "engine/render/eye_renderer.h"
#include "terrain/cast/caster_types.h"

namespace stereonav {

class HoleSort {
public:
    // pixels: row-major, inside bounds. Keeps its memory between calls.
    void sort(const CasterView& view, PixelRect bounds, std::span<const PixelIndex> pixels);

    // Bands that hold many holes; they may hold other pixels too.
    std::span<const CasterBand> dense() const { return mDense; }
    // The holes outside those bands, lower rays first.
    std::span<const PixelIndex> sparse() const { return mSparse; }

private:
    std::vector<CasterBand> mDense;
    std::vector<PixelIndex> mSparse;
    std::vector<int> mBlocks;
};

// Returns the view depth in metres at which the ray of pixel p may start: that of known pixels towards lower
// rays (Wan et al. 2004, section 3.2), where these prove it free (caster_kernel.cpp has the rule for any
// view). 0: unknown. Reads viewDepth inside bounds only.
float startInFront(const CasterView& view, const GroundData& ground, PixelRect bounds,
                   const Plane<float>& viewDepth, PixelIndex p);

// Starts for the rays of a view whose window is shifted by less than a pixel from that of the `known` view,
// all of whose depths are known.
class StartBeside {
public:
    // The references must outlive this object.
    StartBeside(const CasterView& view, const CasterView& known, const GroundData& ground,
                const Plane<float>& viewDepth);
    // Returns the view depth, metres, as startInFront() does.
    float of(PixelIndex p) const;

private:
    const CasterView &mView, &mKnown;
    const GroundData& mGround;
    const Plane<float>& mDepth;
    // Shift in pixels from a pixel of the known view to the same pixel of this one.
    double mLane = 0, mStep = 0;
    bool mAny = false;
};

}  // namespace stereonav
