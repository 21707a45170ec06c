// Chooses the first pose over a ground, and a position of the sun for it, where the scene file sets none: by
// what would be seen of a coarse copy of the ground.
#pragma once

#include "engine/camera/pose.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// A first view, and a position of the sun that shows its relief.
struct FirstView {
    Pose pose;
    double sunAzimuth = 0, sunElevation = 0;  // radians, TerrainLook's
};

// Returns the best of some hundred poses around the summit and around the middle of the ground, by the
// content of a 16:9 picture: ground in all of its lower part and nothing near in front, sky above, the
// silhouette of the heights, relief. clearance: least height in metres above the ground, >= 0. verticalFov:
// radians. The result does not depend on the number of threads. Takes about 10 ms for ground of any size.
FirstView chooseFirstView(const Heightfield& ground, double clearance, double verticalFov);

// Returns the given pose, with a sun chosen for it.
FirstView chooseSun(const Heightfield& ground, const Pose& pose, double verticalFov);

}  // namespace stereonav
