// A volume that rays are cast into, as a scene to fly in or around.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/volume/seen_light.h"
#include "app/scene/volume/traced_light.h"
#include "app/scene/volume/world.h"
#include "engine/frame/cast_frames.h"
#include "engine/scene/scene_limits.h"
#include "engine/scene/shown_values.h"
#include "engine/scene/surface_paint.h"
#include "engine/scene/wall_to_see.h"

namespace stereonav {

// The light of a volume beside its look, shared by the scenes of one study.
struct VolumeLighting {
    std::shared_ptr<LazyLight> lazy;      // computed while it is shown; else null
    std::shared_ptr<TracedLight> traced;  // for every pixel of a picture; else null
    std::shared_ptr<TurningSky> sky;      // sky over baked transfer, with SceneOptions::skyTurns; else null
    std::optional<double> modulateSigma;  // given or chosen sigma of opacity modulation; empty: no modulation
};

// A volume and its light, read from options, before it is decided how frames are made.
struct LitVolume {
    std::unique_ptr<VolumeWorld> world;
    VolumeLighting light;
};

// Offers RayCast, SurfaceChoices, ShownValues and its world's capabilities (VolumeWorld::offerAll);
// TurningLight, SeenLight and PictureLight where they exist; SurfacePaint and WallToSee for an opaque colon.
class ShownVolume final : public Scene {
public:
    // first: the options that the study was loaded with; made: the options of this scene, at first the same.
    // before: the scene of the same study that this one is derived from, null for the first.
    ShownVolume(LitVolume volume, const SceneOptions& first, const SceneOptions& made, SimdTarget target,
                const ShownValues* before = nullptr);

    // Paints the wall in pictures; to be called before the first, at most once.
    void setPaint(std::vector<std::shared_ptr<const EyePainter>> painters);

    FrameMaker& frames() const override;
    std::unique_ptr<Flight> makeFlight() const override;
    void check(const RecordedPath& flight, const std::string& file) const override;
    Facts describe() const override;
    std::string whyLightStays() const override;

private:
    void offerLight();
    void offerPaint();
    void setChoices();
    void setValues(const ShownValues* before);
    void setAmbient();
    void setLimits();
    std::shared_ptr<Scene> changed(const SurfaceChange& change, Progress& progress) const;

    SceneOptions mFirst, mMade;
    std::unique_ptr<VolumeWorld> mWorld;
    VolumeLighting mLighting;
    VolumeRenderer mRenderer;
    RayCast mRays;
    ShownValues mValues;
    mutable CastFrames mFrames;
    std::unique_ptr<SeenVolumeLight> mLight;  // light that is computed while it is shown, or turns; else null
    SurfaceChoices mChoices;
    SceneLimits mLimits;
    std::vector<std::shared_ptr<const EyePainter>> mPainters;  // chosen by options, also while translucent
    SurfacePaint mPaint;
    std::unique_ptr<WallToSee> mWall;  // for a colon; else null
};

// Applies the user's change to `options`; first: the options that the study was loaded with.
void applyChange(const SurfaceChange& change, const SceneOptions& first, SceneOptions& options);

}  // namespace stereonav
