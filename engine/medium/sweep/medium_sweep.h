// Sweeps a medium slice by slice, with SIMD and all threads: light and eyes advance together (Kniss et al.
// 2003), and both eyes use one light. Keeps its buffers between frames. Results do not depend on the thread
// count.
#pragma once

#include <memory>
#include <span>

#include "engine/medium/model/medium_picture.h"
#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

struct SweepTimings {
    double light_ms = 0, eye_ms = 0;
    // Numbers of samples in tiles and slabs that were not left out as empty, passed or dark.
    long long lightTexels = 0, eyeSamples = 0;
};

class MediumSweep {
public:
    // medium must outlive the sweep. Prepares the skipping of empty space.
    explicit MediumSweep(const Medium& medium, SimdTarget target = SimdTarget::Auto);
    ~MediumSweep();

    // Makes the pictures. pictures: one for each eye, resized. head: world, metres; time: seconds.
    // startDepths: empty, or one plane per eye: a view depth before which nothing is expected (0: unknown;
    // infinite: nothing at all), from a splat of depths (W12 of docs/ledger.md); samples more than a slab
    // before it are left out. Throws Error for settings, lights and sizes that do not fit.
    SweepTimings render(const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                        const glm::dvec3& head, double time, std::span<MediumPicture> pictures,
                        std::span<const Plane<float>> startDepths = {});

    // Makes the same with slices from elsewhere.
    SweepTimings render(const MediumLook& look, const SweepSetting& setting, const SweepGeometry& geometry,
                        double time, std::span<MediumPicture> pictures,
                        std::span<const Plane<float>> startDepths = {});

    // Lets all light pass, also where no eye reads it any more: for comparisons.
    void passAllLight(bool all);

    SimdTarget target() const;
    std::size_t heldBytes() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
