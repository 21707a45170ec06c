// Where to stand first over ground whose scene file does not say it, and where the sun stands then: chosen
// from what would be seen of a coarse copy of the ground.
#pragma once

#include "engine/camera/pose.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// A first view, and a sun that shows its relief.
struct FirstView {
    Pose pose;
    double sunAzimuth = 0, sunElevation = 0;  // radians, TerrainLook's
};

// Returns the best of some hundred poses around the summit and around the middle of the ground, by what a
// 16:9 picture would show: ground in all of its lower part and nothing near in front, sky above, the
// silhouette of the heights, relief. clearance: metres above the ground, >= 0, kept in any case. verticalFov:
// radians. The result is the same for any number of threads. It takes some 10 ms for ground of any size.
FirstView chooseFirstView(const Heightfield& ground, double clearance, double verticalFov);

// Returns the same with the sun alone chosen, for a pose that is given.
FirstView chooseSun(const Heightfield& ground, const Pose& pose, double verticalFov);

}  // namespace stereonav
