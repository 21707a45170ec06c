// A colon's wall laid flat, and as a panorama from both ends, for the window.
#pragma once

#include "colon/instruments/shared_wall.h"
#include "engine/scene/flat_wall.h"

namespace stereonav {

class VolumeFlatWall final : public FlatWall {
public:
    // The colon must outlive this object and its pictures.
    VolumeFlatWall(const ColonScene& colon, const SharedWall& wall) : mColon(colon), mWall(wall) {}
    std::shared_ptr<const FlatPicture> makeFlat(Progress& progress) const override;
    std::shared_ptr<const FlatPicture> makePanorama(Progress& progress) const override;

private:
    const ColonScene& mColon;
    const SharedWall& mWall;
};

}  // namespace stereonav
