// The view-dependent highlight of a terrain (wet ground, ice, water): Blinn-Phong towards the sun. It is
// the only part of a pixel that the other eye sees differently, so it is evaluated again there (Wan et
// al. 2004, section 4), with their table in place of the power function.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/packed_normal.h"
#include "terrain/scene_file.h"

namespace stereonav {

class Specular {
public:
    explicit Specular(const TerrainLook& look);
    bool active() const { return mStrength > 0; }
    const glm::dvec3& toSun() const { return mToSun; }  // unit
    // toEye: unit, from the point. Adds the highlight to base.
    PackedColor shade(PackedColor base, const glm::dvec3& normal, const glm::dvec3& toEye) const;
    // cosine^shininess by linear interpolation in a table; cosine in [0, 1]. The absolute error is below
    // shininess^2 / (8 * kEntries^2) of full strength.
    float power(float cosine) const;

    static constexpr int kEntries = 4096;

private:
    float mStrength;
    glm::dvec3 mToSun;
    std::vector<float> mPower;  // empty where there is no highlight
};

}  // namespace stereonav
