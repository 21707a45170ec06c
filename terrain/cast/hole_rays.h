// How scattered pixels of terrain are cast: where holes are dense, as small bands (packets of whole rows,
// each ray led by the one below); elsewhere one by one, each started just in front of what is known.
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

// Returns the view depth, metres, from which the ray of pixel p may start: that of known pixels towards lower
// rays (Wan et al. 2004, section 3.2), where they prove its way free (caster_kernel.cpp has the rule for any
// view). 0: nothing is known. Reads viewDepth inside bounds only.
float startInFront(const CasterView& view, const GroundData& ground, PixelRect bounds,
                   const Plane<float>& viewDepth, PixelIndex p);

// Where rays of a view may start whose window lies less than a pixel beside that of the `known` view, all of
// whose depths are there.
class StartBeside {
public:
    // The references must outlive this.
    StartBeside(const CasterView& view, const CasterView& known, const GroundData& ground,
                const Plane<float>& viewDepth);
    // Returns the view depth, metres, as startInFront() does.
    float of(PixelIndex p) const;

private:
    const CasterView &mView, &mKnown;
    const GroundData& mGround;
    const Plane<float>& mDepth;
    double mLane = 0, mStep = 0;  // pixels from one of the known view to the same of the other
    bool mAny = false;
};

}  // namespace stereonav
