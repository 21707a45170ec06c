// The wall of a colon as triangles, made once for all instruments that measure on it at a time.
#pragma once

#include <memory>
#include <mutex>

#include "colon/scene/colon_scene.h"
#include "colon/wall/wall_mesh.h"

namespace stereonav {

struct JoinedWall {
    WallMesh mesh;
    WallNeighbours neighbours;
};

// Throws as wallMesh.
std::shared_ptr<const JoinedWall> joinedWall(const ColonScene& colon, Progress& progress);

// Holds nothing itself: a wall lives as long as somebody measures on it. Any number of threads.
class SharedWall {
public:
    // A colon, which must outlive it.
    explicit SharedWall(const ColonScene& colon) : mColon(colon) {}

    // Makes it where nobody has it; who asks meanwhile waits for that one. Throws as wallMesh.
    std::shared_ptr<const JoinedWall> get(Progress& progress) const;

private:
    const ColonScene& mColon;
    mutable std::mutex mMutex;
    mutable std::weak_ptr<const JoinedWall> mWall;
};

}  // namespace stereonav
