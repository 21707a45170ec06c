// The view-dependent highlight of a terrain (wet ground, ice, water): Blinn-Phong towards the sun. Only it
// and fog differ for the other eye, so it is evaluated again there (Wan et al. 2004, section 4), with the
// paper's table in place of the power function.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/packed_normal.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

class Specular {
public:
    // sunlight: factor on the strength of the sun's light, by colour; after sunset there is no highlight.
    explicit Specular(const TerrainLook& look, const glm::vec3& sunlight = glm::vec3(1.0f));
    bool active() const { return mStrength > 0; }       // whether the look has highlights at all
    const glm::dvec3& toSun() const { return mToSun; }  // unit
    // Returns the linear light that ground with this unit normal sends in the direction toEye (unit, from the
    // ground) where nothing hides the sun; 0 where it faces away from the sun.
    glm::vec3 highlight(const glm::dvec3& normal, const glm::dvec3& toEye) const;
    // Returns cosine^shininess by linear interpolation in a table; cosine in [0, 1]. The absolute error is
    // below shininess^2 / (8 * kEntries^2) of the full strength.
    float power(float cosine) const;

    static constexpr int kEntries = 4096;  // steps of the table

private:
    float mStrength;            // TerrainLook::specular
    glm::vec3 mColor{0.0f};     // a full highlight, linear
    glm::dvec3 mToSun;          // unit
    std::vector<float> mPower;  // empty where there is no highlight
};

}  // namespace stereonav
