// A volume to fly in or around, cast or swept: the study, the room that it leaves for the eyes, the way
// through it, and its slices.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "app/options/scene_options.h"
#include "app/scene/volume/colon_findings.h"
#include "app/scene/volume/flat_wall.h"
#include "app/scene/volume/inside.h"
#include "app/scene/volume/line_match.h"
#include "colon/flight/colon_flight.h"
#include "colon/scene/colon_scene.h"
#include "engine/nav/flight.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/place_reader.h"
#include "engine/scene/scene.h"
#include "engine/scene/seen_from_outside.h"
#include "engine/scene/slices.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {

class VolumeWorld final : public RoomAround, public SliceSource, public PlaceReader {
public:
    // options: those that the volume was loaded with.
    VolumeWorld(ColonScene colon, const SceneOptions& options);

    // Sets lens, eyes, start and flight, with the changes of the options; to be called before setWall().
    void setViews(const SceneOptions& options, Scene& scene);
    // wall: the renderer of this volume; null: pictures do not measure the room. Lives as long as this
    // object.
    void setWall(const EyeRenderer* wall) { mWall = wall; }

    ColonScene& colon() { return mColon; }
    const ColonScene& colon() const { return mColon; }
    const SharedWall& wall() const { return mSharedWall; }  // only for a colon
    const VolumeSide& side() const { return *mSide; }
    // Calls offer(capability) for each capability, whether the volume is cast or swept.
    template <typename Offer>
    void offerAll(const Offer& offer) {
        offer(static_cast<RoomAround&>(*this));
        offer(static_cast<SliceSource&>(*this));
        offer(std::as_const(mColon));
        offer(std::as_const(mBox));
        offer(static_cast<const PlaceReader&>(*this));
        const ColonInterior* const interior = mSide->interior();
        if (!interior) return offer(std::as_const(mOutside));
        offer(*interior);
        offer(static_cast<const LineThrough&>(*interior));
        offer(interior->lineOnMap());
        offer(static_cast<const FlatWall&>(mFlatWall));
        offer(static_cast<const MatchingLine&>(mLine));
        offer(static_cast<SurfaceFindings&>(mFindings));
    }
    std::unique_ptr<Flight> makeFlight() const;
    // Throws Error that names `file` where a pose lies outside the permitted space.
    void check(const RecordedPath& path, const std::string& file) const { mSide->check(path, file); }
    // Returns whether the eyes come together in narrow places: the options set no separation.
    bool eyesFollow() const { return mFollows && mSide->narrows(); }

    StereoFollower makeFollower(const StereoSetting& from) const override;
    double clearanceAt(const Pose& head) const override;
    double largestSeparation() const override { return mLimits.largest; }
    bool followsAtStart() const override { return mFollows; }
    const EyeRenderer* wallForPictures() const override { return eyesFollow() ? mWall : nullptr; }

    std::shared_ptr<const SliceStudy> readSlices(Progress& progress) const override;
    const MaskVolume* lumen() const override { return mSide->region(); }
    const std::vector<glm::dvec3>& seeds() const override { return mOptions.segmentation.seeds; }
    const PieceChoices& pieceChoices() const override { return mOptions.segmentation.choices; }
    Facts readPlace(const glm::dvec3& world) const override;

private:
    ColonScene mColon;
    ColonOptions mOptions;
    std::unique_ptr<const VolumeSide> mSide;  // side of mColon
    SeparationControl::Setting mLimits;       // limits of the eyes' separation
    bool mFollows = false;
    const EyeRenderer* mWall = nullptr;
    SceneBox mBox;
    SeenFromOutside mOutside;  // only where it is
    // Only for a colon:
    SharedWall mSharedWall{mColon};
    ColonFindings mFindings{mColon, mSharedWall, mOptions};
    VolumeFlatWall mFlatWall{mColon, mSharedWall};
    VolumeLine mLine{mColon};
};

}  // namespace stereonav
