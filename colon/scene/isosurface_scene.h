// A surface of any volume, seen from outside: the isovalue that it has, the place it is seen from, and a
// flight around it.
#pragma once

#include <optional>
#include <string>

#include "colon/scene/colon_scene.h"

namespace stereonav {

// A value for the surface, and the reason.
struct IsovalueChoice {
    double isovalue = 0;  // the volume's values (HU for CT)
    std::string why;      // one clause
};

// Whether values look like Hounsfield units: some are as low as those of air (-500 or less), while other
// volumes begin at 0 or so.
bool looksLikeHounsfield(const GreyVolume& grey);

// Chooses the isovalue. CT: bone where there is some, else skin. Other volumes: the threshold that parts
// their values into the two classes that differ most (Otsu 1979).
IsovalueChoice chooseIsovalue(const GreyVolume& grey);

// Returns the bytes that isosurfaceScene() takes at once beside the values of so many voxels: a border, and
// the distances by which rays leap over empty space. What rays need of the cells that hold surface comes
// after that, and is checked when they are counted.
double surfaceWorking(double voxels);

// Makes the scene. Throws Error when nothing or all of the volume reaches the isovalue, and where memory does
// not suffice; Cancelled.
ColonScene isosurfaceScene(GreyVolume grey, const ColonOptions& options, Progress& progress);

// Sets another isovalue (one of the volume's values; none: the present one), and the transfer function of the
// options. scene: made by isosurfaceScene(), and rendered by no one meanwhile. Does nothing where the scene
// shows just that. Throws as isosurfaceScene(), and then leaves the scene as it was.
void setSurface(ColonScene& scene, const std::optional<double>& isovalue, const ColonOptions& options,
                Progress& progress);

}  // namespace stereonav
