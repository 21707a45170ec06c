// Formulas of docs/volume_light.md as kernels and shaders work them out in pieces: the oracle of both.
#pragma once

#include "engine/medium/sweep/sweep_geometry.h"

namespace stereonav {

// In a slab that leans against the light's way, rays of the light are met after different lengths (V11): how
// much later the next texel to the right, and the next below, meets the plane at t than the texel at (x, y)
// does; metres, times `leaning`, even about the texel.
glm::dvec2 tapLags(const SweepGeometry& geometry, double x, double y, double t);

// Taps of the blur of the light's buffer while it passes a slab (row K3 of docs/ledger.md): taps at `radius`
// texels with together `share` of the weight, the rest for the texel itself. Where the offset is below a
// texel the taps are the four neighbours with a share that spreads just as much (explicit diffusion: never
// below the least nor above the most of its inputs); else they lie on a circle of the offset, turned by a
// hash of texel and slab, read bilinearly.
struct BlurTaps {
    double radius = 1;  // texels, >= 1
    double share = 0;   // 0..1
};
BlurTaps blurTaps(double offset_texels);
// The turn of the taps of a texel: radians in [0, pi / 2). Texels and slab as whole numbers.
double tapTurn(int x, int y, int slab);

// (1 - exp(-x)) / x for x >= 0, 1 at 0.
double meanTransmittance(double x);
// What a slab sends to the eye of light that enters it (docs/volume_light.md, eq. V5 and V6): eyeDepth and
// lightDepth are optical depths of the slab along both rays. Between 0 and 1.
double slabShare(double eyeDepth, double lightDepth, bool forward);

}  // namespace stereonav
