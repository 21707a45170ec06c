// The wall of a colon on which coverage is recorded.
#pragma once

#include "app/scene/volume/inside.h"
#include "colon/instruments/shared_wall.h"
#include "engine/scene/wall_to_see.h"

namespace stereonav {

class VolumeCoverage final : public WallToSee {
public:
    // colon, inside and wall must outlive this object and everything it begins.
    VolumeCoverage(const ColonScene& colon, const ColonInterior& inside, const SharedWall& wall)
        : mColon(colon), mInside(inside), mWall(wall) {}

    std::unique_ptr<WallSeen> begin(const WallLooking& looking, Progress& progress) const override;
    std::vector<Pose> ownFlight(bool back) const override;

private:
    const ColonScene& mColon;
    const ColonInterior& mInside;
    const SharedWall& mWall;
};

}  // namespace stereonav
