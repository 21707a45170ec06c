// The reference picture of baked light (Wyman et al. 2006, section 3, "a brute-force approach"; Y11 of
// docs/ledger.md): paths traced from what every pixel shows, with nothing stored and nothing interpolated.
// Hits are those of the volume's caster, paths those of the bake: the two pictures differ by the lookup and
// by noise alone.
#pragma once

#include "engine/base/progress.h"
#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/light/paths/texel_light.h"
#include "engine/volume/volume_scene.h"

namespace stereonav {

class PixelPaths {
public:
    // scene must outlive this; it shows an opaque surface. Throws Error as TexelLighter does.
    PixelPaths(const VolumeScene& scene, const LightSetup& setup, const TexelSampling& sampling = {});

    // Adds samples to each pixel of `sums`, which is sized as the depths, all new ones zero. viewDepth: as
    // the volume's caster gives it for `view`; pixels without a surface get samples -1. stream: pictures of
    // different numbers have noise of their own. On all threads, whose number changes nothing. Throws
    // Cancelled.
    void add(const EyeView& view, const Plane<float>& viewDepth, std::uint32_t stream, int samples,
             Plane<TexelSum>& sums, Progress& progress) const;

private:
    void addRow(const EyeView& view, const float* depths, int y, std::uint64_t firstNumber, int samples,
                std::span<TexelSum> sums) const;

    const VolumeScene& mScene;
    TexelLighter mLighter;
};

// Facts of luminance of irradiance / pi over the pixels that show a surface: its mean, and the root of the
// mean variance of the pixels' means as a share of that of their squares (infinite below two samples). The
// variance is that of independent samples: low discrepancy is better than it says.
struct PixelLightFacts {
    std::size_t pixels = 0;
    double mean = 0, error = 0;
};
PixelLightFacts factsOf(const Plane<TexelSum>& sums);

// Gives pixels that show a surface the colour that the caster would give them under baked light of that
// value and exposure: albedo of the look * light * exposure. The others keep theirs.
void showPixelLight(const VolumeLook& look, const Plane<TexelSum>& sums, float exposure, EyeImage& image);

}  // namespace stereonav
