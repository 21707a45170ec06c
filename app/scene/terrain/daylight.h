// Sky light and shadows of a tinted ground, computed in the background: coarse first, then finer, by the same
// bake as in `bake` (terrain/light/terrain_light.h). Nothing waits for it: the ground is shown under the
// plain sun until light is there. It runs on one thread, which gives way to those that make frames.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "engine/scene/capabilities.h"
#include "engine/simd/simd_target.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Ground under baked light, and the sun's place that its colours are lit from.
struct LitGround {
    const TerrainScene* terrain = nullptr;
    std::shared_ptr<const ColorTexture> plain;  // the ground's own colours under the plain sun
    std::unique_ptr<TerrainIllumination> light;
    ColorTexture color;
    double sunAzimuth = 0, sunElevation = 0;
    SunPlace sunOfColor;  // sun of the plain colours

    // Updates the colours for the sun of `look`. With light at some samples only, shading between them is
    // that of the plain sun.
    void lightAgain(const TerrainLook& look);
    std::string source() const;  // description for facts
};

class TerrainDaylight {
public:
    // The terrain must have a tint, outlive this object, and change only its look, report and landmarks.
    TerrainDaylight(const TerrainScene& terrain, SimdTarget target);
    ~TerrainDaylight();  // returns promptly
    TerrainDaylight(const TerrainDaylight&) = delete;
    TerrainDaylight& operator=(const TerrainDaylight&) = delete;

    // Begins the work; later calls do nothing. plain: the terrain's tint under its sun.
    void begin(std::shared_ptr<const ColorTexture> plain);
    // Returns the newest light since the last call, null where there is none.
    std::unique_ptr<LitGround> take();
    // Returns a number that grows as light comes.
    std::uint64_t count() const { return mCount; }
    // Returns whether no more light will come: all is done, or memory does not suffice.
    bool done() const { return mDone; }

    // Largest number of baked samples in each step; one bake per step, until every sample is baked.
    static constexpr double kMostSamples[] = {6'000, 60'000, 400'000};

private:
    void work(const std::shared_ptr<const ColorTexture>& plain);
    void give(std::unique_ptr<LitGround> lit);

    const TerrainScene& mTerrain;
    const TerrainLook mLook;  // copy of the look at the beginning: the scene's own changes with the sun
    const SimdTarget mTarget;
    std::mutex mMutex;
    std::unique_ptr<LitGround> mNewest;
    std::atomic<std::uint64_t> mCount = 0;
    std::atomic<bool> mStop = false, mDone = false;
    std::shared_ptr<Progress> mProgress;
    std::thread mThread;
};

}  // namespace stereonav
