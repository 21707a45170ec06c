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

// View depth from which the ray of pixel p may start: that of known pixels towards lower rays (Wan et al.
// 2004, section 3.2), where they prove its way free (caster_kernel.cpp has the rule for any view). 0:
// nothing is known. Reads image.viewDepth inside bounds only.
float startInFront(const CasterView& view, const GroundData& ground, PixelRect bounds, const EyeImage& image,
                   PixelIndex p);

}  // namespace stereonav
