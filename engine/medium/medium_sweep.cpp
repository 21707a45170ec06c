// Light and eyes in lock step, a chunk of slabs at a time: the light passes the chunk's slabs one after the
// other and leaves behind what eyes read of it; then each tile of the eyes walks the chunk with what it has
// gathered in registers. Tiles and slabs where the medium's cells are empty are left out.
#include "engine/medium/medium_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/medium/sweep_data.h"
#include "engine/medium/sweep_light.h"
#include "engine/medium/sweep_reach.h"
#include "engine/medium/sweep_space.h"

namespace stereonav {
namespace {

constexpr int kSide = EyeTile::kSide;
constexpr std::size_t kTileNumbers = EyeTile::kMembers * kSide * kSide;

const SweepKernels& kernelsFor(SimdTarget target) {
    if (target == SimdTarget::Avx512) return avx512::kSweepKernels;
    return target == SimdTarget::Avx2 ? avx2::kSweepKernels : plain::kSweepKernels;
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

// One eye's tiles, from frame to frame.
struct EyeBuffers {
    int across = 0, down = 0;
    std::vector<float> states;
    std::vector<std::uint8_t> fresh, done;
    std::vector<SweepBeam> beams;  // of the quarters of each tile

    void start(const RayFan& fan) {
        across = (fan.width + kSide - 1) / kSide;
        down = (fan.height + kSide - 1) / kSide;
        const std::size_t tiles = static_cast<std::size_t>(across) * down;
        if (states.size() < tiles * kTileNumbers) states.resize(tiles * kTileNumbers);
        fresh.assign(tiles, 1);
        done.assign(tiles, 0);
    }
    int tiles() const { return across * down; }
};

}  // namespace

struct MediumSweep::State {
    explicit State(const Medium& m, SimdTarget t)
        : medium(m), target(availableTarget(t)), kernels(kernelsFor(target)), data(m), space(m) {}

    // What a frame is made of.
    struct Frame {
        const SweepGeometry& geometry;
        SweepScene scene;
        std::vector<SweepEye> eyes;
        std::span<const Plane<float>> starts;
    };

    void setBeams(const Frame& frame, std::size_t eye);
    void seeChunk(Frame& frame, const SweepChunk& chunk, int first, int count, SweepTimings& timings);
    void dropPassed();
    void readPicture(std::size_t eye, MediumPicture& picture) const;

    const Medium& medium;
    SimdTarget target;
    const SweepKernels& kernels;
    SweepData data;
    SweepSpace space;
    SweepLightBuffers light;
    SweepReach reach;
    bool passesAll = false;
    std::vector<EyeBuffers> eyes;
};

void MediumSweep::State::setBeams(const Frame& frame, std::size_t eye) {
    const SweepGeometry& g = frame.geometry;
    EyeBuffers& b = eyes[eye];
    b.beams.resize(4 * static_cast<std::size_t>(b.tiles()));
    parallelFor(b.tiles(), [&](int tile) {
        for (int quarter = 0; quarter < 4; ++quarter) {
            constexpr double kHalf = EyeTile::kHalf;
            const double x = tile % b.across * kSide + quarter % 2 * kHalf,
                         y = tile / b.across * kSide + quarter / 2 * kHalf;
            b.beams[4 * static_cast<std::size_t>(tile) + quarter] =
                space.beamOf(g, g.eyes[eye], g.forward, x, y, x + kHalf, y + kHalf);
        }
    });
}

void MediumSweep::State::seeChunk(Frame& frame, const SweepChunk& chunk, int first, int count,
                                  SweepTimings& timings) {
    double middles[SweepChunk::kMost];
    for (int n = 0; n < count; ++n)
        middles[n] = 0.5 * (frame.geometry.faces[first + n] + frame.geometry.faces[first + n + 1]);
    int total = 0;
    for (const EyeBuffers& b : eyes) total += b.tiles();
    std::atomic<long long> samples = 0;
    parallelFor(total, [&](int n) {
        std::size_t eye = 0;
        for (; n >= eyes[eye].tiles(); ++eye) n -= eyes[eye].tiles();
        EyeBuffers& b = eyes[eye];
        if (b.done[n]) return;
        EyeTile tile;
        long long slabs = 0;
        for (int quarter = 0; quarter < 4; ++quarter) {
            tile.slabs[quarter] =
                space.planesMet(b.beams[4 * static_cast<std::size_t>(n) + quarter], middles, count);
            slabs += std::popcount(tile.slabs[quarter]);
        }
        if (slabs == 0) return;
        tile.x0 = n % b.across * kSide;
        tile.y0 = n / b.across * kSide;
        tile.fresh = b.fresh[n];
        tile.state = b.states.data() + n * kTileNumbers;
        if (!frame.starts.empty()) {
            tile.starts = frame.starts[eye].row(tile.y0) + tile.x0;
            tile.startStride = frame.starts[eye].stride();
        }
        b.done[n] = !kernels.seeTile(frame.scene, frame.eyes[eye], chunk, tile);
        b.fresh[n] = 0;
        samples += slabs * EyeTile::kHalf * EyeTile::kHalf;
    });
    timings.eyeSamples += samples;
}

// Tiles of which no ray goes on read no light any more. (One that samples for another eye as well would go
// on.)
void MediumSweep::State::dropPassed() {
    for (std::size_t eye = 0; eye < eyes.size(); ++eye)
        for (int tile = 0; tile < eyes[eye].tiles(); ++tile)
            if (eyes[eye].done[tile]) reach.drop(eye, tile);
}

void MediumSweep::State::readPicture(std::size_t eye, MediumPicture& picture) const {
    const EyeBuffers& b = eyes[eye];
    parallelFor(b.tiles(), [&](int n) {
        const int x0 = n % b.across * kSide, y0 = n / b.across * kSide;
        PictureTile tile;
        tile.light = &picture.light.row(y0)[x0].x;
        tile.depth = picture.viewDepth.row(y0) + x0;
        tile.lightStride = 4 * static_cast<std::int64_t>(picture.light.stride());
        tile.depthStride = picture.viewDepth.stride();
        tile.width = std::min(kSide, picture.light.width() - x0);
        tile.height = std::min(kSide, picture.light.height() - y0);
        if (!b.fresh[n]) {
            kernels.readTile(b.states.data() + n * kTileNumbers, tile);
            return;
        }
        for (int y = 0; y < tile.height; ++y)
            for (int x = 0; x < tile.width; ++x) {
                picture.light.at(x0 + x, y0 + y) = glm::vec4(0, 0, 0, 1);
                picture.viewDepth.at(x0 + x, y0 + y) = kMissDepth;
            }
    });
}

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
    State::Frame frame{geometry, s.data.sceneFor(look, setting, geometry, time), {}, startDepths};
    s.eyes.resize(geometry.eyes.size());
    for (std::size_t eye = 0; eye < geometry.eyes.size(); ++eye) {
        s.eyes[eye].start(geometry.eyes[eye]);
        frame.eyes.push_back(sweepEye(geometry.eyes[eye], geometry));
        s.setBeams(frame, eye);
    }
    SweepTimings timings;
    Stopwatch watch;
    const bool usesLight = geometry.light.width > 0 && geometry.slabs() > 0;
    int most = SweepChunk::kMost;
    if (usesLight) most = s.light.start(frame.scene, geometry, &s.space);
    if (usesLight) s.reach.start(geometry, &s.space, most, EyeTile::kSide, LightTile::kSide);
    for (int first = 0; first < geometry.slabs(); first += most) {
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
            timings.lightTexels += s.light.beginChunk(frame.scene, geometry, first, count, s.kernels,
                                                      s.passesAll ? nullptr : &s.reach);
            for (int n = 0; n < count; ++n)
                timings.lightTexels += s.light.pass(frame.scene, geometry, first + n, n, s.kernels);
        }
        timings.light_ms += watch.lap_ms();
        s.seeChunk(frame, chunk, first, count, timings);
        if (usesLight) s.dropPassed();
        timings.eye_ms += watch.lap_ms();
    }
    for (std::size_t eye = 0; eye < geometry.eyes.size(); ++eye) {
        pictures[eye].light.resize(geometry.eyes[eye].width, geometry.eyes[eye].height);
        pictures[eye].viewDepth.resize(geometry.eyes[eye].width, geometry.eyes[eye].height);
        s.readPicture(eye, pictures[eye]);
    }
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
    std::size_t bytes = mState->data.heldBytes() + mState->space.heldBytes() + mState->light.heldBytes() +
                        mState->reach.heldBytes();
    for (const EyeBuffers& b : mState->eyes)
        bytes += b.states.size() * sizeof(float) + b.beams.size() * sizeof(SweepBeam);
    return bytes;
}

}  // namespace stereonav
