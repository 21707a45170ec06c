// Colours of ground without a picture as they are seen from the air: forest, grass, dry earth, rock, scree,
// snow, sea.
//
// What grows where follows a moisture of 0 to 1, made of the belt of the latitude (dry about 25 degrees), of
// the height in it (dry belts are greener towards their tree line), of wetness and hollows
// (ground_shape.h), of the aspect (slopes that face the pole dry out less, more so in dry belts) and of
// noise. Trees end at the tree line, ice begins at the snow line of the latitude (growthLines()). Colours
// are reflectances of visible light, after the classes of land cover in Oke 1987 (Boundary Layer Climates,
// table 1.1: forest 0.05 to 0.2, grass 0.16 to 0.26, desert 0.20 to 0.45, old to fresh snow 0.40 to 0.95),
// drawn together so that relief stays readable in dark forest and on snow. No map of climates is at hand: a
// wet mountain in a dry belt gets the belt's colours, and regions are up to 1,000 m off in their lines.
//
// Heights without a place on the Earth get a temperate belt whose tree line lies high in their own range, and
// no snow.
#pragma once

#include <vector>

#include "terrain/built_in/noise.h"
#include "terrain/scene/ground_shape.h"
#include "terrain/scene/ground_tint.h"
#include "terrain/scene/ground_tones.h"

namespace stereonav {

class NaturalTones final : public GroundTones {
public:
    // Both grounds must outlive this. place: the whole's.
    NaturalTones(const Heightfield& part, const TintPlace& place, const Heightfield& whole);

    GroundTone at(const glm::dvec2& grid, double height) const override;

    // Returns the linear colour. height: metres as the ground has them, NaN in holes.
    glm::vec3 colorAt(const glm::dvec2& grid, double height, const GroundShape::Site& site) const;
    const GroundShape& shape() const { return mShape; }

private:
    // What a latitude has.
    struct Belt {
        float tree = 0, snow = 0;             // metres
        float arid = 0, cold = 0, polar = 0;  // shares
        float poleward = 0;  // y of the direction to the nearer pole: 1, -1, near the equator 0
    };
    // What a place has, beside the belt.
    struct Spot {
        float metres, up;    // above the sea; as a share of the tree line
        float slope, north;  // metres a metre; -1 to 1: how far it faces the pole
        float fine;          // noise, -1 to 1
    };
    Belt beltAt(double north) const;
    static float moistureOf(const Belt& belt, const GroundShape::Site& site, const Spot& spot);
    static glm::vec3 grownOver(const Belt& belt, const GroundShape::Site& site, const Spot& spot);
    glm::vec3 withRock(const glm::vec3& color, const Belt& belt, const GroundShape::Site& site,
                       const Spot& spot) const;

    const Heightfield &mGround, &mWhole;
    GroundShape mShape;
    double mUnscale = 1;  // metres above the sea for one of the ground's
    double mLow = 0;      // metres: the whole's lowest
    bool mPlaced = false, mSeaFloor = false;
    float mRockFrom = 0.6f, mRockFull = 1.1f;  // slopes, metres a metre
    std::vector<Belt> mBelts;                  // evenly from south to north
    Noise mFine;
};

}  // namespace stereonav
