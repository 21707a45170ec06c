// A volume that rays are cast into, as a scene to fly in or around.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/seen_volume_light.h"
#include "app/scene/traced_light.h"
#include "app/scene/volume_world.h"
#include "engine/frame/cast_frames.h"
#include "engine/scene/shown_values.h"
#include "engine/scene/surface_paint.h"
#include "engine/scene/wall_to_see.h"

namespace stereonav {

// What a volume is lit by beside its look, shared by the scenes that one study is seen as.
struct VolumeLighting {
    std::shared_ptr<LazyLight> lazy;      // worked out while it is shown; else null
    std::shared_ptr<TracedLight> traced;  // of a picture's every pixel; else null
    std::shared_ptr<TurningSky> sky;      // over baked transfer, where SceneOptions::skyTurns; else null
    std::optional<double> modulateSigma;  // of opacity modulation, given or chosen; none: without
};

// A volume and its light, read as options say, before it is decided how its frames are made.
struct LitVolume {
    std::unique_ptr<VolumeWorld> world;
    VolumeLighting light;
};

// Offers RayCast, SurfaceChoices, ShownValues and what its world has (VolumeWorld::offerAll); as they are
// there, TurningLight, SeenLight, PictureLight; SurfacePaint and WallToSee of an opaque colon.
class ShownVolume final : public Scene {
public:
    // first: the options that the study was loaded with, made: those that this scene shows; the same at
    // first. before: of a scene of the same study that this one is made of, null for the first.
    ShownVolume(LitVolume volume, const SceneOptions& first, const SceneOptions& made, SimdTarget target,
                const ShownValues* before = nullptr);

    // Paints the wall in pictures that are shown: before the first, at most once.
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
    std::shared_ptr<Scene> changed(const SurfaceChange& change, Progress& progress) const;

    SceneOptions mFirst, mMade;
    std::unique_ptr<VolumeWorld> mWorld;
    VolumeLighting mLighting;
    VolumeRenderer mRenderer;
    RayCast mRays;
    ShownValues mValues;
    mutable CastFrames mFrames;
    std::unique_ptr<SeenVolumeLight> mLight;  // that is worked out while one looks, or turns; else null
    SurfaceChoices mChoices;
    std::vector<std::shared_ptr<const EyePainter>> mPainters;  // by the options, also while translucent
    SurfacePaint mPaint;
    std::unique_ptr<WallToSee> mWall;  // of a colon; else null
};

// What the user changed, into `options`; `first`: those that the study was loaded with.
void applyChange(const SurfaceChange& change, const SceneOptions& first, SceneOptions& options);

}  // namespace stereonav
