// Finds the colon's lumen in a CT: air, and fluid made bright by a contrast agent, told from lungs, other
// bowel gas and the air around the patient by density, place, size and shape.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "colon/segmentation/mask_smoothing.h"
#include "engine/base/progress.h"
#include "engine/volume/components.h"
#include "engine/volume/piece_choices.h"
#include "engine/volume/volume.h"

namespace stereonav {

struct SegmentationSetting {
    double air = -700;              // HU: below is air
    double tagged = 200;            // HU: above is tagged fluid, where it has a level surface under air
    double wall = -450;             // HU: the wall is this isosurface (half way between air and tissue)
    std::vector<glm::dvec3> seeds;  // world, metres: pieces that hold one are the colon; empty: chosen
    PieceChoices choices;           // pieces of air and pools that are, or are not, the colon's all the same
    bool leavesFluid = false;       // tagged fluid stays: its surface is wall, the lumen is air alone
    MaskSmoothing maskSmoothing = 0;  // a ready mask's wall; 0: by a wide kernel (lumen_surface.h)
};

// A piece of the lumen, in order from rectum to caecum.
struct LumenSegment {
    std::size_t voxels = 0;
    double volume = 0;             // cubic metres
    glm::ivec3 first{0}, last{0};  // bounding box, last included
};

// A lumen and the field whose isosurface is its wall. Both have the same frame: the study's, cropped to the
// lumen and a margin of some voxels. A voxel is in the lumen exactly if its value is below isovalue and it
// is connected (by faces) to the lumen.
struct LumenField {
    GreyVolume field;
    double isovalue = 0;  // stored numbers of `field`
    MaskVolume lumen;     // the segment's number, 1, 2, ... in order; 0 outside
    std::vector<LumenSegment> segments;
    std::vector<std::string> notes;  // what was found and left out, one line each
};

// Finds the lumen in grey values. Tagged fluid becomes air in `field`, without a film between it and the air
// above, unless it is left; it ties the air above it to the colon all the same. known: voxels below
// setting.air, where they were looked for already. Throws Error (no air, all air, seeds outside, nothing like
// a colon), Cancelled.
LumenField segmentColon(const GreyVolume& study, const SegmentationSetting& setting, Progress& progress,
                        std::optional<VoxelRuns> known = {});
// Finds the same in a study that nobody needs afterwards: its values go slice by slice as the field's come.
LumenField segmentColon(GreyVolume&& study, const SegmentationSetting& setting, Progress& progress,
                        std::optional<VoxelRuns> known = {});

// Returns the field and the segments of a lumen (numbered from 1) that was found in this study with this
// setting and kept: what segmentColon gives, without judging any air again. Returns nothing where they do not
// fit together.
std::optional<LumenField> restoreLumen(const GreyVolume& study, MaskVolume lumen,
                                       const SegmentationSetting& setting);

// Makes the lumen of a ready mask: `field` is the mask smoothed so that the wall shows no stairs, scaled to
// HU-like numbers. Of the setting seeds, choices and smoothing count. Throws Error on an empty or full mask;
// Cancelled.
LumenField lumenFromMask(const MaskVolume& mask, const SegmentationSetting& setting, Progress& progress);

}  // namespace stereonav
