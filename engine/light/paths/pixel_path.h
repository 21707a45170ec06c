// The reference picture of baked light (Wyman et al. 2006, section 3, "a brute-force approach"; Y11 of
// docs/ledger.md): paths traced from the point that each pixel shows, with nothing stored or interpolated.
// Hits are those of the volume's caster, paths those of the bake, so that the two pictures differ only by the
// lookup and by noise.
#pragma once

#include "engine/base/progress.h"
#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/light/paths/texel_light.h"
#include "engine/volume/volume_scene.h"

namespace stereonav {

class PixelPaths {
public:
    // scene must outlive this object and show an opaque surface. Throws Error as TexelLighter does.
    PixelPaths(const VolumeScene& scene, const LightSetup& setup, const TexelSampling& sampling = {});

    // Adds samples to each pixel of `sums`, which gets the size of the depths; new pixels are zero.
    // viewDepth: from the volume's caster for `view`; pixels without a surface get samples -1. stream:
    // pictures with different numbers have independent noise. Runs on all threads; results do not depend on
    // their number. Throws Cancelled.
    void add(const EyeView& view, const Plane<float>& viewDepth, std::uint32_t stream, int samples,
             Plane<TexelSum>& sums, Progress& progress) const;

private:
    void addRow(const EyeView& view, const float* depths, int y, std::uint64_t firstNumber, int samples,
                std::span<TexelSum> sums) const;

    const VolumeScene& mScene;
    TexelLighter mLighter;
};

// Statistics of luminance of irradiance / pi over the pixels that show a surface: the mean, and the root mean
// variance of the pixels' means relative to their root mean square (infinite below two samples). The variance
// assumes independent samples; with low discrepancy the true error is smaller.
struct PixelLightFacts {
    std::size_t pixels = 0;
    double mean = 0, error = 0;
};
PixelLightFacts factsOf(const Plane<TexelSum>& sums);

// Colours the pixels that show a surface as the caster would under baked light of this value: albedo of the
// look * light * exposure. Other pixels are unchanged.
void showPixelLight(const VolumeLook& look, const Plane<TexelSum>& sums, float exposure, EyeImage& image);

}  // namespace stereonav
