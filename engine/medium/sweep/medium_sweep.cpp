// Light and eyes advance in lock step, one chunk of slabs at a time. First the light passes the slabs of the
// chunk, and what the eyes need of it before each slab is stored. Then each tile of an eye's pixels passes
// the same slabs, with the light and opacity that its rays have gathered held in registers. Tiles and slabs
// where the medium is empty are skipped.
#include "engine/medium/sweep/medium_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/base/loop_watch.h"
#include "engine/base/stopwatch.h"
#include "engine/medium/sweep/sweep_data.h"
#include "engine/medium/sweep/sweep_eyes.h"
#include "engine/medium/sweep/sweep_light.h"
#include "engine/medium/sweep/sweep_reach.h"
#include "engine/medium/sweep/sweep_space.h"

namespace stereonav {
namespace {

const SweepKernels& kernelsFor(SimdTarget target) {
    return kernelsOf(target, plain::kSweepKernels, avx2::kSweepKernels, avx512::kSweepKernels);
}

void checkSpans(const SweepGeometry& geometry, std::span<MediumPicture> pictures,
                std::span<const Plane<float>> starts) {
    const std::size_t eyes = geometry.eyes.size();
    if (pictures.size() != eyes || (!starts.empty() && starts.size() != eyes))
        throw Error(
            "", "sweep",
            fmt::format("{} eyes need as many pictures, got {}, and as many planes of depths or none, got {}",
                        eyes, pictures.size(), starts.size()),
            "hand in one for each eye");
    for (std::size_t n = 0; n < starts.size(); ++n)
        if (starts[n].width() != geometry.eyes[n].width || starts[n].height() != geometry.eyes[n].height)
            throw Error(
                "", "sweep",
                fmt::format("depths of eye {} are {} x {}, its picture {} x {}", n + 1, starts[n].width(),
                            starts[n].height(), geometry.eyes[n].width, geometry.eyes[n].height),
                "hand in depths of the picture's size");
}

}  // namespace

struct MediumSweep::State {
    explicit State(const Medium& m, SimdTarget t)
        : medium(m),
          target(availableTarget(t)),
          kernels(kernelsFor(target)),
          data(m),
          space(m),
          eyes(space, kernels),
          finest(finestDetail(m)) {}

    const Medium& medium;
    SimdTarget target;
    const SweepKernels& kernels;
    SweepData data;
    SweepSpace space;
    SweepLightBuffers light;
    SweepReach reach;
    bool passesAll = false;
    SweepEyes eyes;
    double finest;  // metres: size of the medium's finest detail
};

MediumSweep::MediumSweep(const Medium& medium, SimdTarget target)
    : mState(std::make_unique<State>(medium, target)) {}

MediumSweep::~MediumSweep() = default;

SweepTimings MediumSweep::render(const MediumLook& look, const SweepSetting& setting,
                                 std::span<const EyeView> eyes, const glm::dvec3& head, double time,
                                 std::span<MediumPicture> pictures,
                                 std::span<const Plane<float>> startDepths) {
    return render(look, setting, makeSweepGeometry(mState->medium, look, setting, eyes, head), time, pictures,
                  startDepths);
}

SweepTimings MediumSweep::render(const MediumLook& look, const SweepSetting& setting,
                                 const SweepGeometry& geometry, double time,
                                 std::span<MediumPicture> pictures,
                                 std::span<const Plane<float>> startDepths) {
    checkSpans(geometry, pictures, startDepths);
    State& s = *mState;
    SweepScene scene = s.data.sceneFor(look, setting, geometry, time);
    s.eyes.start(geometry, SweepSharing(geometry, s.medium.bounds(), setting.sharedWidth * s.finest),
                 startDepths);
    SweepTimings timings;
    Stopwatch watch;
    const bool usesLight = geometry.light.width > 0 && geometry.slabs() > 0;
    int most = SweepChunk::kMost;
    if (usesLight) most = s.light.start(scene, geometry, &s.space);
    if (usesLight) s.reach.start(geometry, &s.space, most, EyeTile::kSide, LightTile::kSide);
    LoopSteps steps((geometry.slabs() + most - 1) / most);
    for (int first = 0; first < geometry.slabs(); first += most, steps.next()) {
        const int count = std::min(most, geometry.slabs() - first);
        SweepChunk chunk;
        chunk.reference = 0.5 * (geometry.faces[first] + geometry.faces[first + count]);
        for (int n = 0; n < count; ++n) {
            const double low = geometry.faces[first + n], high = geometry.faces[first + n + 1];
            chunk.middle[n] = static_cast<float>(0.5 * (low + high) - chunk.reference);
            chunk.thickness[n] = static_cast<float>(high - low);
        }
        watch.lap_ms();
        if (usesLight) {
            timings.lightTexels += s.light.beginChunk(scene, geometry, first, count, s.kernels,
                                                      s.passesAll ? nullptr : &s.reach);
            for (int n = 0; n < count; ++n)
                timings.lightTexels += s.light.pass(scene, geometry, first + n, n, s.kernels);
        }
        timings.light_ms += watch.lap_ms();
        timings.eyeSamples += s.eyes.seeChunk(scene, chunk, first, count);
        if (usesLight) s.eyes.dropPassed(s.reach);
        timings.eye_ms += watch.lap_ms();
    }
    for (std::size_t eye = 0; eye < geometry.eyes.size(); ++eye) s.eyes.readPicture(eye, pictures[eye]);
    timings.eye_ms += watch.lap_ms();
    return timings;
}

void MediumSweep::passAllLight(bool all) {
    mState->passesAll = all;
}

SimdTarget MediumSweep::target() const {
    return mState->target;
}

std::size_t MediumSweep::heldBytes() const {
    return mState->data.heldBytes() + mState->space.heldBytes() + mState->light.heldBytes() +
           mState->reach.heldBytes() + mState->eyes.heldBytes();
}

}  // namespace stereonav
