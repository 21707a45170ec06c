// The truth for volume light: a path tracer through the medium (delta tracking of Woodcock et al. 1965, ratio
// tracking for shadow rays), with every order of scattering and the same phase functions. It has no slices,
// cone or blur.
#pragma once

#include <cstdint>

#include "engine/camera/eye_view.h"
#include "engine/medium/model/medium.h"
#include "engine/medium/model/medium_look.h"
#include "engine/medium/model/medium_picture.h"

namespace stereonav {

struct ExtinctionBounds;

struct TrackingSetting {
    int samples = 64;       // paths a pixel
    int mostScatters = 64;  // paths end after so many; 1: single scattering, the model's direct light
    std::uint32_t seed = 1;
    // Counts only light that between its scatters never travels against the light's own direction: all that
    // half-angle slicing can carry. The rest is what slicing misses in principle.
    bool onlyForward = false;
};

struct TrackedPicture {
    Plane<glm::vec4> light;  // the same as MediumPicture::light
    // Linear RGB squared: variance of the mean of each pixel's samples; infinite for one sample.
    Plane<glm::vec3> variance;
};

// Rows from `first` up to, but not including, `end`.
struct PictureRows {
    int first = 0, end = 0;
};
// Traces these rows of a picture; the others stay 0. Rays go through the pixels' centres, as in sweeps.
// bounds: of the medium at that time (delta_tracking_bounds.h), made once by callers that trace in parts.
// time: seconds. Results do not depend on the thread count. Surface weights, Blinn-Phong and baked light are
// not supported: throws Error unless the medium's S is 0, for the surface model, and unless samples and
// mostScatters are at least 1. With model Direct paths end at the first scatter. Light that was scattered
// more than once is multiplied by indirectShare, so that 1 is the truth. The light's irradiance across its
// direction is radiance * 4 pi (see MediumLight::radiance).
TrackedPicture trackRows(const Medium& medium, const ExtinctionBounds& bounds, const MediumLook& look,
                         const EyeView& view, const TrackingSetting& setting, double time,
                         const PictureRows& rows);

}  // namespace stereonav
