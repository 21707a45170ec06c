// A medium that is swept, as a scene to fly around or in: built in, or made of a terrain or a volume, which
// it then holds.
#pragma once

#include <memory>
#include <optional>

#include "app/scene/shown_volume.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/medium/sweep/swept_frames.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Offers MediumScene, SweptFrames, LightModels, SweepPlace; as they are there, Animation, TurningLight; of
// what it is made of, const TerrainScene or const ColonScene, RoomAround, SliceSource, LineThrough,
// SeenLight.
class ShownMedium final : public Scene {
public:
    ShownMedium() : mMedium(std::make_unique<MediumScene>()) {}
    ~ShownMedium() override;

    // First what it is made of, at most one; then the medium; then begin(), after which nothing of it changes
    // but its look.
    const TerrainScene& hold(TerrainScene terrain);
    VolumeWorld& hold(LitVolume volume);
    MediumScene& medium() { return *mMedium; }
    // Without ground or walls: one may enter.
    void flyFreely();
    void begin(SimdTarget target);

    FrameMaker& frames() const override { return *mFrames; }
    std::unique_ptr<Flight> makeFlight() const override;
    void check(const RecordedPath& flight, const std::string& file) const override;
    std::string whyLightStays() const override;

private:
    class Models;
    class Place;
    class Sun;

    std::unique_ptr<TerrainScene> mTerrain;
    LitVolume mVolume;
    std::unique_ptr<SeenVolumeLight> mVolumeLight;
    std::unique_ptr<EyeRenderer> mWall;  // of a colon: tells its eyes of the room
    std::unique_ptr<MediumScene> mMedium;
    std::unique_ptr<SweptFrames> mFrames;
    std::unique_ptr<LightModels> mModels;
    std::unique_ptr<TurningLight> mSun;  // of parallel light; else null
    std::unique_ptr<SweepPlace> mPlace;
    Animation mAnimation;
    std::optional<double> mFreeExtent;  // metres, of what is flown around freely; none: as what it is made of
};

}  // namespace stereonav
