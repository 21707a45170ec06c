// Any volume as a surface seen from outside: which values it lies between, from where it is seen, and a
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

// Whether values look like Hounsfield units: these have some near those of air; other volumes begin at 0 or
// so.
bool looksLikeHounsfield(const GreyVolume& grey);

// Chooses the isovalue. CT: bone where there is some, else skin. Others: between the two kinds of values that
// differ most (Otsu 1979).
IsovalueChoice chooseIsovalue(const GreyVolume& grey);

// Returns the bytes that isosurfaceScene() takes at once beside the values of so many voxels: a border, and
// what leaps are measured with. What rays need of the cells that hold surface comes after that, and is
// checked when they are counted.
double surfaceWorking(double voxels);

// Makes the scene. Throws Error when nothing or all of the volume reaches the isovalue, and where memory does
// not suffice; Cancelled.
ColonScene isosurfaceScene(GreyVolume grey, const ColonOptions& options, Progress& progress);

// Sets another isovalue (of the volume's values; none: the present one), and the transfer function of the
// options, for a scene made by isosurfaceScene, which no one may be rendering meanwhile. Where that is what
// it shows nothing is done. Throws as isosurfaceScene, and leaves the scene as it was.
void setSurface(ColonScene& scene, const std::optional<double>& isovalue, const ColonOptions& options,
                Progress& progress);

}  // namespace stereonav
