// The truth for volume light: a path tracer through the medium itself (delta tracking of Woodcock et al.
// 1965, ratio tracking for shadow rays), every order of scattering, the same phase functions. No slices, no
// cone, no blur.
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
    int mostScatters = 64;  // 1: single scattering, what the model calls direct light; paths end there
    std::uint32_t seed = 1;
    // Counts only light that between its scatters never travels against the light's own way: all that
    // half-angle slicing could carry. What is missing is what it misses in principle.
    bool onlyForward = false;
};

struct TrackedPicture {
    Plane<glm::vec4> light;  // the same as MediumPicture::light
    // Linear RGB squared: variance of the mean of each pixel's samples; infinite for one sample.
    Plane<glm::vec3> variance;
};

// Rows from `first` to before `end`.
struct PictureRows {
    int first = 0, end = 0;
};
// Traces these rows of a picture; the others stay 0. Rays go through the pixels' centres, as those of the
// sweeps. bounds: of the medium at that time (delta_tracking_bounds.h), made once for who traces it in parts.
// time: seconds. Does not depend on the thread count. The surface weight S, Blinn-Phong and baked light have
// no counterpart here: throws Error unless the medium's S is 0, for that model, and unless samples and
// mostScatters are at least 1. With model Direct paths end at the first scatter. Light that was scattered
// more than once counts times indirectShare, so 1 is the truth. Light enters as radiance * 4 pi across its
// way (see MediumLight::radiance).
TrackedPicture trackRows(const Medium& medium, const ExtinctionBounds& bounds, const MediumLook& look,
                         const EyeView& view, const TrackingSetting& setting, double time,
                         const PictureRows& rows);

}  // namespace stereonav
