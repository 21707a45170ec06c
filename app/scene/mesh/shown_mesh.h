// A glTF mesh, its triangles cast with Embree, as a scene to fly around.
#pragma once

#include "app/options/scene_options.h"
#include "engine/frame/cast_frames.h"
#include "engine/mesh/mesh_renderer.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"
#include "engine/scene/seen_from_outside.h"

namespace stereonav {

// Offers RayCast, const MeshRenderer, SceneBox, SeenFromOutside and a TurningLight.
class ShownMesh final : public Scene {
public:
    // options: the first view, and the direction of the light where one is given.
    ShownMesh(MeshCaster caster, const SceneOptions& options, SimdTarget target);

    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override;
    Facts describe() const override;

private:
    class Sun final : public TurningLight {
    public:
        explicit Sun(MeshRenderer& renderer) : mRenderer(renderer) {}
        SunPlace place() const override { return mPlace; }
        void turnTo(const SunPlace& place) override;

    private:
        MeshRenderer& mRenderer;
        SunPlace mPlace;
    };

    MeshRenderer mRenderer;
    RayCast mRays;
    mutable CastFrames mFrames;
    Sun mSun;
    SceneBox mBox;
    SeenFromOutside mOutside;
};

}  // namespace stereonav
