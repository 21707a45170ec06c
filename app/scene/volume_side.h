// The side of its wall that a volume is seen from. A colon is flown through: its wall is closed around the
// eyes, light from outside never gets in, and a line leads along it (volume_inside.h). Any other volume is
// looked at from outside, by whatever light, and its surface may be moved. What options, light, eyes and
// flight make of that is asked here.
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

    // Throws Error for an option that is for volumes seen from outside, where this is none.
    virtual void expectOutside(
        const char* option,
        const std::string& problem = "expected with a volume seen from outside, this one is a colon",
        const std::string& advice = "add --isosurface, or leave it out") const = 0;
    // Where its surface is and can be moved from, in the study's values; none: it has the one wall.
    virtual std::optional<double> movableIsovalue() const = 0;

    // Where its surface is lit and outlined; null: wherever it is. Lives as long as the volume.
    virtual const MaskVolume* region() const = 0;
    // Of the volume, the same however it was loaded. Throws Cancelled.
    virtual std::uint64_t content(Progress& progress) const = 0;

    // Whether light from outside reaches what is seen.
    virtual bool letsLightIn() const = 0;
    // Throw Error for light that is asked for and never gets there; of a bake, and of one that is worked out
    // while one looks (a sky was given, or is baked over as transfer).
    virtual void checkLight(const BakeOptions& options, BakeKind kind) const = 0;
    virtual void checkLazyLight(bool transfer, bool sky) const = 0;
    // Lights so many metres apart along the way through it; none: as usual. Throws Error naming the option.
    virtual void addLine(const std::optional<double>& spacing, const char* option,
                         LightSetup& setup) const = 0;
    // What it is lit by where nothing is said, with a note on it. option: what gives lights.
    virtual void addUsualLight(const char* option, LightSetup& setup,
                               std::vector<std::string>& notes) const = 0;
    // How far rays look for openness where nothing is said, metres, with a note on it; 0: without end.
    virtual double usualReach(std::vector<std::string>& notes) const = 0;

    // Metres that eyes get apart by themselves; may be infinite.
    virtual double largestSeparation() const = 0;
    // Whether it gets too narrow for eyes that stay as they are.
    virtual bool narrows() const = 0;
    // At normal speed, across its box.
    virtual double crossingSeconds() const = 0;
    // Throws Error naming `file` where a recorded flight goes where none can be.
    virtual void check(const RecordedPath& path, const std::string& file) const = 0;

    // What only a colon has; null: it is seen from outside.
    virtual const ColonInterior* interior() const { return nullptr; }
};

// The volume must outlive it, and stay where it is.
std::unique_ptr<const VolumeSide> sideOf(const ColonScene& volume);

}  // namespace stereonav
