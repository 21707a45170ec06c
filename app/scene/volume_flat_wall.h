// A colon's wall laid flat, for the window.
#pragma once

#include "colon/scene/colon_scene.h"
#include "engine/scene/flat_wall.h"

namespace stereonav {

class VolumeFlatWall final : public FlatWall {
public:
    // A colon, which must outlive it and its pictures.
    explicit VolumeFlatWall(const ColonScene& colon) : mColon(colon) {}
    std::shared_ptr<const FlatPicture> makeFlat(Progress& progress) const override;

private:
    const ColonScene& mColon;
};

}  // namespace stereonav
