// From the light of a scene to what a display shows: exposure, and a shoulder in place of clipped highlights.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace stereonav {

// Linear RGB from a scene's linear RGB, for each channel by itself. Below knee() it is the light times the
// exposure; from there to `white` it is the rational curve of Reinhard et al. 2002 (Photographic Tone
// Reproduction, eq. 4), moved so that it leaves the straight line without a bend and reaches 1 at `white`.
struct ToneCurve {
    float exposure = 1;  // factor on light, more than 0
    float white = 1;     // light after exposure that becomes 1; at most 1: the straight line alone

    bool plain() const { return exposure == 1 && !(white > 1); }
    // Returns where the shoulder begins, in (0.6, 1]: the more there is to compress, the lower.
    float knee() const { return white > 1 ? 0.6f + 0.4f / white : 1; }
    // linear: any values. Where there is a shoulder NaN becomes 0 and what is above `white` 1.
    glm::vec3 operator()(const glm::vec3& linear) const {
        const glm::vec3 light = exposure * linear;
        if (!(white > 1)) return light;
        return {shoulder(light.x), shoulder(light.y), shoulder(light.z)};
    }

private:
    float shoulder(float light) const {
        const float from = knee(), rest = 1 - from;
        if (!(light > from)) return light > 0 ? light : 0;
        if (light >= white) return 1;
        const float u = (light - from) / rest, most = (white - from) / rest;
        return from + rest * u * (1 + u / most / most) / (1 + u);
    }
};

}  // namespace stereonav
