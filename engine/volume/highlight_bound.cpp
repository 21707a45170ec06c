#include "engine/volume/highlight_bound.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

// Returns the least light that a place sends, whatever its normal is; 0 with a transfer function, whose
// colours may be black.
double leastLight(const VolumeLook& look) {
    if (!look.transfer.empty() || look.showsOpenness() || look.showsStudio()) return 0;
    const double albedo = std::min({look.surface.x, look.surface.y, look.surface.z});
    return std::max(0.0, albedo * look.ambient * (1 - std::abs(look.varyingAmbient)));
}

}  // namespace

double faintHighlightCosine(const VolumeLook& look) {
    if (!(look.specular > 0)) return 0;
    const double share = kFaintHighlight / 1023;  // share of a channel's square root
    const double faint = std::max(share * share, 2 * share * std::sqrt(leastLight(look)));
    return std::pow(faint / look.specular, 1.0 / std::max(look.shininess, 1e-3f));
}

}  // namespace stereonav
