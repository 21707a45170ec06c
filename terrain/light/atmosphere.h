// The sky and the air of a clear or hazy day by scattering of sunlight, from the place of the sun and how far
// one can see.
//
// Single scattering in molecules and haze, each with a density that falls exponentially with height: T.
// Nishita, T. Sirai, K. Tadamura, E. Nakamae, Display of the Earth Taking into Account Atmospheric
// Scattering, SIGGRAPH 1993. Scale heights (8 and 1.2 km), the molecules' extinction, the haze's albedo (0.9)
// and its phase function are those of E. Bruneton, F. Neyret, Precomputed Atmospheric Scattering, EGSR 2008
// (section 2.1; g 0.76). The haze's amount is Koschmieder's: at the sea, over the meteorological range, 2 %
// of a contrast are left (3.912 optical depths of green). No ozone. Light that is scattered more than once
// counts as uniform, with the strength that the two-stream approximation of K. N. Liou, An Introduction to
// Atmospheric Radiation, lets through beyond the rest.
//
// Brightness and white follow the scene's look: level ground in the open gets white light of strength 1 with
// the sun 45 degrees high. Ground is shown as bright until the sun has set; sky and air follow the light
// half-way (by its root), which keeps a low sun's sky from being all white.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/light/skies/sky_map.h"
#include "terrain/light/air_data.h"
#include "terrain/light/air_formula.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

// The effect of the air on light that passes it, by colour: the transmittance, 0 to 1, and the light that the
// air adds, linear.
struct AirSeen {
    glm::dvec3 through{1.0}, light{0.0};
};

class Atmosphere {
public:
    // Makes the air and sky of a look with a physical sky. Any place of the sun; a visibility of 0 counts as
    // 10 m, an infinite one as that of molecules alone.
    explicit Atmosphere(const TerrainLook& look);

    // Returns the air between an eye and eye + t * direction: world, metres; direction of any length but 0.
    AirSeen along(const glm::dvec3& eye, const glm::dvec3& direction, double t) const;

    // Returns the light of the sky, linear, with the sun's disc, seen from the look's height over the round
    // Earth; below the horizon a level grey plain, in the haze where the look says so. direction: unit.
    glm::vec3 sky(const glm::vec3& direction) const;

    const AirData& data() const { return mAir; }
    // Returns the air data of an eye. worldHeight: metres.
    AirEye eyeAt(double worldHeight) const;

private:
    struct Elevation {
        // Light, linear, for a phase of 1; ground: the share of the plain's light that is left.
        glm::vec3 molecules, haze, ambient, ground;
    };
    double sunlightAt(double height, int channel) const;
    Elevation elevation(double sine) const;
    void makeSunlight(double elevation);
    void makeElevations();

    AirData mAir;
    double mSeenFrom = 0;  // metres above the sea
    bool mHazyBelow = false;
    glm::dvec3 mToSun{0, 0, 1}, mSunlight{0.0};  // unit; above the air, linear
    double mSunUp = 1;                           // share of the disc above the horizontal
    glm::vec3 mGround{0.0f};                     // what the plain sends out, linear
    std::vector<glm::dvec3> mThroughToSun;       // by height: share of sunlight that is left
    std::vector<Elevation> mElevations;
};

// Returns a map of the whole sky.
SkyMap skyMapOf(const Atmosphere& air);

}  // namespace stereonav
