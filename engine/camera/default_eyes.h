// The default separation of the eyes, where neither an option nor a scene file sets it. It is defined only
// here.
#pragma once

#include "engine/camera/stereo_rig.h"

namespace stereonav {

// Zero-parallax distance divided by the separation (Wan et al. 2004).
constexpr int kUsualParts = 30;
constexpr double kUsualShare = 1.0 / kUsualParts;

// Kinds of views, which determine the default eyes.
enum class SeenAs {
    Ground,   // ground, from the scene's start
    Track,    // ground below a track that is flown
    Lumen,    // from inside
    Outside,  // a whole volume or medium, from outside
    Mesh      // a whole mesh, from outside
};

// Returns the default eyes for a screen `zeroParallax` metres away, > 0.
constexpr StereoSetting defaultEyes(SeenAs seen, double zeroParallax) {
    switch (seen) {
        // A division, which rounds differently in the last bit than a factor of one thirtieth.
        case SeenAs::Ground:
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
