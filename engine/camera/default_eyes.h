// How far apart the eyes stand where neither an option nor a scene's file says it. This is the one place that
// decides it.
#pragma once

#include "engine/camera/stereo_rig.h"

namespace stereonav {

// The zero-parallax distance in separations, and a separation as a share of it (Wan et al. 2004).
constexpr int kUsualParts = 30;
constexpr double kUsualShare = 1.0 / kUsualParts;

// Kinds of views, from which the default eyes follow.
enum class SeenAs {
    Ground,   // from its start
    Track,    // ground below a track that is flown
    Lumen,    // from inside
    Outside,  // a volume or a medium, whole
    Mesh      // whole
};

// Returns the eyes for a screen `zeroParallax` metres away, > 0.
constexpr StereoSetting defaultEyes(SeenAs seen, double zeroParallax) {
    switch (seen) {
        case SeenAs::Ground:  // rounds otherwise than a thirtieth, by the last bit
            return {kUsualShare * zeroParallax, zeroParallax};
        case SeenAs::Mesh:  // a mesh's depths span half of its distance
            return {zeroParallax / 45, zeroParallax};
        case SeenAs::Track:
        case SeenAs::Lumen:
        case SeenAs::Outside:
            break;
    }
    return {zeroParallax / kUsualParts, zeroParallax};
}

}  // namespace stereonav
