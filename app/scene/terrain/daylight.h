// Sky light and shadows of a tinted ground, computed in the background: coarse first, then finer, by the same
// bake as in `bake` (terrain/light/terrain_light.h). Nothing waits for it: the ground is shown under the
// plain sun until light is there. It runs on one thread, which gives way to those that make frames.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "app/scene/terrain/behind_frames.h"
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

    // Begins the work; later calls do nothing. plain: the terrain's tint under its sun.
    void begin(std::shared_ptr<const ColorTexture> plain);
    // Returns the newest light since the last call, null where there is none.
    std::unique_ptr<LitGround> take() { return mWork.take(); }
    std::uint64_t count() const { return mWork.count(); }  // grows as light comes
    bool done() const { return mWork.done(); }             // whether no more light will come

    // Largest number of baked samples in each step; one bake per step, until every sample is baked.
    static constexpr double kMostSamples[] = {6'000, 60'000, 400'000};

private:
    void work(const std::shared_ptr<const ColorTexture>& plain);

    const TerrainScene& mTerrain;
    const TerrainLook mLook;  // copy of the look at the beginning: the scene's own changes with the sun
    const SimdTarget mTarget;
    BehindFrames<std::unique_ptr<LitGround>> mWork;
};

}  // namespace stereonav
