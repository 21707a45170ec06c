// Sky light and shadows of a tinted ground, worked out behind the window: coarse first, then finer, by the
// same bake as `bake` runs (terrain/light/terrain_light.h). Nothing waits for it: the ground is shown under
// the plain sun until light is there. It runs on one thread that steps back behind those that make frames.
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

// Ground under baked light, and the place of the sun that its colours are lit from.
struct LitGround {
    const TerrainScene* terrain = nullptr;
    std::shared_ptr<const ColorTexture> plain;  // the ground's own colours under the plain sun
    std::unique_ptr<TerrainIllumination> light;
    ColorTexture color;
    double sunAzimuth = 0, sunElevation = 0;
    SunPlace sunOfColor;  // that of the plain colours

    // Of light at some samples alone the shades between them are those of the plain sun.
    void lightAgain(const TerrainLook& look);
    std::string source() const;  // for facts
};

class TerrainDaylight {
public:
    // terrain: has a tint, lives longer, and changes in nothing but its look, report and landmarks.
    TerrainDaylight(const TerrainScene& terrain, SimdTarget target);
    ~TerrainDaylight();  // prompt
    TerrainDaylight(const TerrainDaylight&) = delete;
    TerrainDaylight& operator=(const TerrainDaylight&) = delete;

    // Starts it; later calls do nothing. plain: the terrain's tint under its sun.
    void begin(std::shared_ptr<const ColorTexture> plain);
    // The newest light since the last call, null where there is none.
    std::unique_ptr<LitGround> take();
    // Grows as light comes.
    std::uint64_t count() const { return mCount; }
    // Whether no more will come: all is done, or there is no memory for it.
    bool done() const { return mDone; }

    // Samples that are baked at most, step by step; one bake each, until every sample is.
    static constexpr double kMostSamples[] = {6'000, 60'000, 400'000};

private:
    void work(const std::shared_ptr<const ColorTexture>& plain);
    void give(std::unique_ptr<LitGround> lit);

    const TerrainScene& mTerrain;
    const TerrainLook mLook;  // as it was: the scene's changes with the sun
    const SimdTarget mTarget;
    std::mutex mMutex;
    std::unique_ptr<LitGround> mNewest;
    std::atomic<std::uint64_t> mCount = 0;
    std::atomic<bool> mStop = false, mDone = false;
    std::shared_ptr<Progress> mProgress;
    std::thread mThread;
};

}  // namespace stereonav
