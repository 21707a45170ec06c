// Where the lamp's highlight is too faint to be seen: kernels leave it out there, and who shades a warped
// picture again is as fast as without one.
#pragma once

#include "engine/volume/volume_look.h"

namespace stereonav {

// Steps of a packed channel (0.4 of an 8-bit sRGB level at most) that may be left out.
constexpr double kFaintHighlight = 0.5;

// Returns a least sum of cosines. With c the cosine between normal and lamp, e the metres from eye to lamp
// and d those from the point to the lamp: where c + e / d is less than this, the highlight changes no packed
// channel by more than kFaintHighlight.
//   The vector half way between lamp and eye is off the lamp's direction by half the angle between them,
//   whose sine is at most e / d; so the normal's cosine with it is at most c + e / d =: C, and the highlight
//   at most h = specular * C^shininess, of a lamp of 1. That adds 1023 (sqrt(L + h) - sqrt(L)) steps to a
//   channel of light L: at most 1023 sqrt(h), and at most 1023 h / (2 sqrt(L)), where L is no less than the
//   ambient light of the darkest channel. A weaker lamp, fog and a share of the lamp make both L and h less,
//   and so the change too.
// The result is 1 and more where all have to be looked at; 0 without a highlight.
double faintHighlightCosine(const VolumeLook& look);

}  // namespace stereonav
