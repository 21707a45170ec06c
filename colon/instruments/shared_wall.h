// The wall of a colon as triangles, made once for all instruments that measure on it at the same time.
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

// Makes the wall of a colon. Throws as wallMesh().
std::shared_ptr<const JoinedWall> joinedWall(const ColonScene& colon, Progress& progress);

// Gives the wall to all its users, on any number of threads: it lives as long as one of them holds it.
class SharedWall {
public:
    // colon must outlive the object.
    explicit SharedWall(const ColonScene& colon) : mColon(colon) {}

    // Returns the wall, and makes it where nobody holds it; other callers wait meanwhile for the same one.
    // Throws as wallMesh().
    std::shared_ptr<const JoinedWall> get(Progress& progress) const;

private:
    const ColonScene& mColon;
    mutable std::mutex mMutex;
    mutable std::weak_ptr<const JoinedWall> mWall;
};

}  // namespace stereonav
