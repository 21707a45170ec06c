// A volume ready to fly in: the lumen of a colon with its centreline, or any CT volume as an isosurface
// seen from outside.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "colon/built_in/built_in_colon.h"
#include "colon/centreline/centreline.h"
#include "colon/scene/value_kinds.h"
#include "colon/segmentation/segmentation.h"
#include "colon/study/study.h"
#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "engine/volume/value_range.h"
#include "engine/volume/volume_scene.h"
#include "engine/volume/volume_up.h"

namespace stereonav {

// What is chosen for a volume seen from outside where no option says it.
struct ChosenForVolume {
    // Whether values are looked at for what is shown: the isovalue, presets of transfer functions, which way
    // is up. Else the isovalue alone is chosen, by another rule.
    bool values = false;
    bool baked = false;         // light is baked: isovalue and way up are those without a look at values
    bool view = false;          // the view by what is seen, else by its box
    double aspect = 16.0 / 9;   // width of the picture by its height
    std::optional<double> fov;  // vertical, radians; not given: the scene's own
};

struct ColonOptions {
    std::filesystem::path study;  // empty: the built-in colon
    BuiltInColonSetting builtIn;
    StudyOptions reading;
    SegmentationSetting segmentation;
    CentrelineSetting centreline;
    bool isosurface = false;         // show any volume from outside, without looking for a colon
    std::optional<double> isovalue;  // the surface's, in the volume's values; not given: chosen from them
    std::filesystem::path transfer;  // a transfer function, by file or name: translucent
    std::optional<double> opacity;   // opacity of a translucent wall, a millimetre, in (0, 1]
    double clearance = 0;            // metres; 0: chosen
    std::optional<UpAxis> up;        // for a volume seen from outside; not given: z
    bool cache = true;
    bool keepsStudy = false;  // ColonScene::study is asked for
    ChosenForVolume chosen;
    bool wetWall = false;  // a colon's wall looks as an endoscope shows it; else matt and evenly lit
};

struct ColonScene {
    std::string name, format;
    VolumeFrame studyFrame;  // the study's as read; the volume's may be a part of it, or have a border
    std::vector<std::string> notes;
    VolumeScene volume;
    // The study's own grey values, HU, for a colon, where they are asked for (keepsStudy): of which `volume`
    // has neither the tagged fluid nor what is far from the wall. Empty for a mask, which has none.
    GreyVolume study;
    // The smallest and the largest value of a colon's box in the study, tagged fluid made air, when it was
    // found, HU. The cache keeps no values far from the lumen, but these two.
    ValueSpan valuesFound;
    // The lumen of a colon; empty for a volume seen from outside.
    LumenField lumen;  // without `field`, which is moved into volume.field
    Centreline centreline;
    std::vector<Polyp> polyps;

    // Counts of values of a volume seen from outside, where they were looked at (ChosenForVolume::values);
    // else null.
    std::shared_ptr<const ValueCounts> counts;
    ValueKinds kinds;
    // Metres along the wall over which a mask was smoothed, 0: not at all; nothing where the study is no
    // mask.
    std::optional<double> maskSmoothed;
    std::optional<UpAxis> up;  // axis of the file that was turned up, by an option or guessed
    std::string warning;       // what has to be said to who sees a picture of it; "": nothing

    Pose startPose;
    RecordedPath path;  // along the centreline, or around the volume
    Lens lens;
    StereoSetting stereo;
    double clearance = 0.002;  // metres kept from the wall
    double extent = 0.3;       // metres, from which speeds are chosen

    bool isColon() const { return !centreline.points.empty(); }
    // Returns the distance free of wall around a world point, metres; never above the true one. At most upTo.
    double freeDistanceAt(const glm::dvec3& world, double upTo) const;
};

// Loads a colon or volume: reads or makes the study, finds the lumen or takes it from the cache, and builds
// what casting needs. Throws Error, Cancelled.
ColonScene loadColon(const ColonOptions& options, Progress& progress);

// Returns the same study with the isovalue (for a volume seen from outside; none: the present one), the
// transfer function and the opacity of the options; the rest is the scene's own, in the same memory where it
// is large. Places and paths stay where they are. Throws Error, Cancelled.
ColonScene changedScene(const ColonScene& scene, const ColonOptions& options, Progress& progress);

}  // namespace stereonav
