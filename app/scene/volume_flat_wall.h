// A colon's wall laid flat, and seen from both ends, for the window.
#pragma once

#include "colon/instruments/shared_wall.h"
#include "engine/scene/flat_wall.h"

namespace stereonav {

class VolumeFlatWall final : public FlatWall {
public:
    // A colon, which must outlive it and its pictures, and its wall.
    VolumeFlatWall(const ColonScene& colon, const SharedWall& wall) : mColon(colon), mWall(wall) {}
    std::shared_ptr<const FlatPicture> makeFlat(Progress& progress) const override;
    std::shared_ptr<const FlatPicture> makePanorama(Progress& progress) const override;

private:
    const ColonScene& mColon;
    const SharedWall& mWall;
};

}  // namespace stereonav
