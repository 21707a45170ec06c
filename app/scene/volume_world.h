// A volume to fly in or around, however its frames are made: the study, the room that it leaves around the
// eyes, the way through it and the slices that it came from.
#pragma once

#include <memory>
#include <vector>

#include "app/command/commands.h"
#include "colon/flight/colon_flight.h"
#include "colon/scene/colon_scene.h"
#include "engine/nav/flight.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"
#include "engine/scene/slices.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {

class VolumeWorld final : public RoomAround, public LineThrough, public SliceSource {
public:
    // options: that it was loaded with. wall: whose rays tell pictures of the room (wallForPictures).
    VolumeWorld(ColonScene colon, const SceneOptions& options);

    // Lens, eyes, start and flight, with what the options change; before setRoom().
    void setViews(const SceneOptions& options, Scene& scene);
    // wall: casts this volume; null: nothing tells pictures of the room. Lives as long as this.
    void setWall(const EyeRenderer* wall) { mWall = wall; }

    ColonScene& colon() { return mColon; }
    const ColonScene& colon() const { return mColon; }
    std::unique_ptr<Flight> makeFlight() const;
    // Throws Error naming `file` where a pose lies outside the lumen; any path goes around what is no colon.
    void check(const RecordedPath& path, const std::string& file) const;
    // Whether eyes come together where a colon is narrow: the options don't say where they are.
    bool eyesFollow() const { return mFollows && mColon.isColon(); }

    StereoFollower makeFollower(const StereoSetting& from) const override;
    double clearanceAt(const Pose& head) const override;
    double largestSeparation() const override { return mLimits.largest; }
    bool followsAtStart() const override { return mFollows; }
    const EyeRenderer* wallForPictures() const override { return eyesFollow() ? mWall : nullptr; }

    PlaceOnLine placeOnLine(const glm::dvec3& world) const override;

    std::shared_ptr<const SliceStudy> readSlices(Progress& progress) const override;
    const MaskVolume* lumen() const override { return mColon.isColon() ? &mColon.lumen.lumen : nullptr; }
    const std::vector<glm::dvec3>& seeds() const override { return mOptions.segmentation.seeds; }

private:
    ColonScene mColon;
    ColonOptions mOptions;
    SeparationControl::Setting mLimits;  // of the eyes
    bool mFollows = false;
    const EyeRenderer* mWall = nullptr;
};

}  // namespace stereonav
