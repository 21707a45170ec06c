// A surface of any volume, seen from outside: the isovalue that it has, the place it is seen from, and a
// flight around it.
#pragma once

#include <optional>

#include "colon/scene/colon_scene.h"
#include "colon/scene/value_kinds.h"

namespace stereonav {

// Returns whether values look like Hounsfield units: some are as low as those of air (-500 or less), while
// the values of other volumes begin near 0.
bool looksLikeHounsfield(const GreyVolume& grey);

// Chooses the isovalue where values are not looked at further (isovalueFor() does). CT: bone where there is
// some, else skin. Other volumes: the threshold that parts their values into the two classes that differ most
// (Otsu 1979).
IsovalueChoice chooseIsovalue(const GreyVolume& grey);

// Returns the bytes of memory that isosurfaceScene() needs for a volume of `voxels` voxels beside their
// values: for a border, and for the distances by which rays leap over empty space. What it stores for each
// cell that holds surface is not included: that is checked once these cells are counted.
double surfaceWorking(double voxels);

// What is known of a volume beside its values.
struct VolumeOrigin {
    bool directed =
        true;  // the file says how its axes lie; else the way up may be guessed (ColonOptions::chosen)
    bool mask = false;  // values are 0 and one other
};

// Makes the scene; a mask is smoothed if the options say so, with its own two values far from the wall.
// Throws Error when nothing or all of the volume reaches the isovalue, and where memory does not suffice;
// Cancelled.
ColonScene isosurfaceScene(GreyVolume grey, const ColonOptions& options, Progress& progress,
                           const VolumeOrigin& origin = {});

// Sets another isovalue (in units of the volume's values; none: keeps the present one) and the transfer
// function of the options. scene: made by isosurfaceScene(); nobody may render it meanwhile. Does nothing
// where both stay the same. Throws as isosurfaceScene() does, and then leaves the scene unchanged.
void setSurface(ColonScene& scene, const std::optional<double>& isovalue, const ColonOptions& options,
                Progress& progress);

}  // namespace stereonav
