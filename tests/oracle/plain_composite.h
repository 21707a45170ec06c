// Light and translucent samples along one ray, in double precision, nothing shared with the fast code but the
// data: what the volume caster's kernels are tested against.
#pragma once

#include "engine/volume/plain_volume_caster.h"

namespace stereonav {

// shadePlain under look.baked, where there is any: light known at the position (bakedLightAt) in place of the
// lamp's beside lampShare of that, or the lamp's weakened by openness.
glm::dvec3 shadeBakedPlain(const VolumeLook& look, const glm::dvec3& position, const glm::dvec3& normal,
                           const glm::dvec3& head, const glm::dvec3& eye, const glm::dvec3& albedo);

// The same at a point of voxel space of a volume under the whole look: where look.occlusion is shown, its
// strength * openness * albedo and lampShare of the lamp's direct light (that without look.ambient), else as
// shadeBakedPlain.
glm::dvec3 lightPlain(const VolumeLook& look, const VolumeFrame& frame, const glm::dvec3& voxel,
                      const glm::dvec3& normal, const glm::dvec3& head, const glm::dvec3& eye,
                      const glm::dvec3& albedo);

struct PlainComposite {
    glm::dvec3 color{0.0};  // linear RGB, background not included
    double left = 1;        // share of the background that is still seen
    double firstDepth = std::numeric_limits<double>::infinity();  // t of the first sample that is not clear
    double spread = 0;  // root of the mean square distance (in t) behind firstDepth that light comes from
    int samples = 0;    // taken within the volume
};

// Front to back along samples at path lengths k * stepVoxels * (smallest spacing), k = 0, 1, ..., from
// nearDepth on, each of opacity 1 - exp(-extinction * step), the extinction times
// look.modulation where there is one, and shaded by shadeBakedPlain; ends where less than 1/1024 is left.
PlainComposite compositePlain(const GreyVolume& volume, const VolumeLook& look, const PlainRay& ray,
                              const glm::dvec3& head, double stepVoxels);

// Front to back from cell to cell, as VolumeCasting::integrated gathers: each in two pieces of equal length,
// in one where less than 0.3 is left. A piece has the means of the extinction, and of it times the colour,
// over the values between its ends' (Engel, Kraus and Ertl 2001); its light falls onto the middle of what is
// not clear.
PlainComposite integratePlain(const GreyVolume& volume, const VolumeLook& look, const PlainRay& ray,
                              const glm::dvec3& head);

}  // namespace stereonav
