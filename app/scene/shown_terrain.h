// A terrain that rays are cast into, as a scene to fly over.
#pragma once

#include <optional>

#include "engine/frame/cast_frames.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Over the ground, as its extent asks for. terrain: lives as long as the flight.
std::unique_ptr<Flight> flightOver(const TerrainScene& terrain);
// What a terrain says of lens, eyes, start and flight.
void setViews(const TerrainScene& terrain, Scene& scene);

// Offers RayCast, const TerrainScene; with baked light, a TurningLight.
class ShownTerrain final : public Scene {
public:
    ShownTerrain(TerrainScene terrain, SimdTarget target);

    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override { return flightOver(mTerrain); }
    Facts describe() const override;
    std::string whyLightStays() const override;

private:
    class Sun;

    TerrainScene mTerrain;
    TerrainRenderer mRenderer;
    RayCast mRays;
    mutable CastFrames mFrames;
    std::unique_ptr<TurningLight> mSun;  // null: it stands in the colours
};

}  // namespace stereonav
