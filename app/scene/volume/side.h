// The side of its wall that a volume is seen from. A colon is flown through: its wall is closed around the
// eyes, light from outside never enters, and a line leads along it (inside.h). Any other volume is
// seen from outside, under any light, and its surface may be moved. Options, light, eyes and flight depend on
// it through this class.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options/bake_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/camera/recorded_path.h"
#include "engine/light/bake/bake_sums.h"
#include "engine/light/skies/light_setup.h"

namespace stereonav {

class ColonInterior;

class VolumeSide {
public:
    virtual ~VolumeSide() = default;

    // Throws Error for an option for volumes seen from outside, where this is a colon.
    virtual void expectOutside(
        const char* option,
        const std::string& problem = "needs a volume seen from outside, this one is a colon",
        const std::string& advice = "add --isosurface, or leave it out") const = 0;
    // Returns the surface's isovalue, in the study's values, where it can be moved; empty for a colon, whose
    // wall is fixed.
    virtual std::optional<double> movableIsovalue() const = 0;

    // Returns the voxels in which the surface is lit and outlined; null: all. Lives as long as the volume.
    virtual const MaskVolume* region() const = 0;
    // Returns a hash of the volume that does not depend on how it was loaded. Throws Cancelled.
    virtual std::uint64_t content(Progress& progress) const = 0;

    // Returns whether light from outside reaches the surface.
    virtual bool letsLightIn() const = 0;
    // Throw Error for light that can not reach the surface: of a bake, and of light that is computed while it
    // is shown (where a sky was given, or the light is baked as transfer).
    virtual void checkLight(const BakeOptions& options, BakeKind kind) const = 0;
    virtual void checkLazyLight(bool transfer, bool sky) const = 0;
    // Adds lamps at this distance along the way through the volume; empty: the default. Throws Error that
    // names the option.
    virtual void addLine(const std::optional<double>& spacing, const char* option,
                         LightSetup& setup) const = 0;
    // Adds the default light, with a note on it. option: the one that gives lamps.
    virtual void addUsualLight(const char* option, LightSetup& setup,
                               std::vector<std::string>& notes) const = 0;
    // Returns the default length of rays for openness in metres, with a note on it; 0: unlimited.
    virtual double usualReach(std::vector<std::string>& notes) const = 0;

    // Returns the largest automatic separation of the eyes in metres; may be infinite.
    virtual double largestSeparation() const = 0;
    // Returns whether the room gets too narrow for a fixed separation of the eyes.
    virtual bool narrows() const = 0;
    // Returns the time to cross the volume's box at normal speed.
    virtual double crossingSeconds() const = 0;
    // Throws Error that names `file` where a flight from a file leaves the permitted space.
    virtual void check(const RecordedPath& path, const std::string& file) const = 0;

    // Returns what only a colon has; null for volumes seen from outside.
    virtual const ColonInterior* interior() const { return nullptr; }
};

// The volume must outlive the result, and stay where it is.
std::unique_ptr<const VolumeSide> sideOf(const ColonScene& volume);

}  // namespace stereonav
