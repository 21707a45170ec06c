#include "colon/instruments/shared_wall.h"

namespace stereonav {

std::shared_ptr<const JoinedWall> joinedWall(const ColonScene& colon, Progress& progress) {
    auto wall = std::make_shared<JoinedWall>();
    wall->mesh = wallMesh(colon.volume.field, colon.volume.cells, colon.lumen.lumen, progress);
    wall->neighbours = neighboursOf(wall->mesh);
    return wall;
}

std::shared_ptr<const JoinedWall> SharedWall::get(Progress& progress) const {
    const std::lock_guard lock(mMutex);
    std::shared_ptr<const JoinedWall> wall = mWall.lock();
    progress.report(0, "making the wall's mesh");
    if (!wall) mWall = wall = joinedWall(mColon, progress);
    progress.report(1, "making the wall's mesh");
    return wall;
}

}  // namespace stereonav
