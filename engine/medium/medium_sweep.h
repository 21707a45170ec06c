// Sweeps a medium slice by slice, with SIMD and all threads: light and eyes in lock step (Kniss et al. 2003),
// both eyes from one light. Keeps its buffers between frames. What it makes does not depend on the thread
// count.
#pragma once

#include <memory>
#include <span>

#include "engine/math/simd_target.h"
#include "engine/medium/medium_picture.h"
#include "engine/medium/sweep_geometry.h"

namespace stereonav {

struct SweepTimings {
    double light_ms = 0, eye_ms = 0;
    long long lightTexels = 0, eyeSamples = 0;  // computed, empty ones skipped
};

class MediumSweep {
public:
    // medium must outlive the sweep. Builds what skips empty space.
    explicit MediumSweep(const Medium& medium, SimdTarget target = SimdTarget::Auto);
    ~MediumSweep();

    // pictures: one for each eye, resized. startDepths: empty, or one plane an eye: a view depth before which
    // nothing is expected (0: unknown), as a depth splat gives it (W12).
    SweepTimings render(const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                        const glm::dvec3& head, double time, std::span<MediumPicture> pictures,
                        std::span<const Plane<float>> startDepths = {});

    SimdTarget target() const;
    std::size_t heldBytes() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
