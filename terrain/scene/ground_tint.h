// The ground's own colour where no picture is laid over it: tints by height, environment and slope.
//
// Taken from Patterson and Jenny 2011 (The Development and Rationale of Cross-blended Hypsometric Tints,
// Cartographic Perspectives 69): their four scales (arid, warm humid, cold humid, polar) by height, whose
// lowlands have the colours of their environment and whose highlands are alike, blended into one another
// from region to region; after Imhof (Kartographische Geländedarstellung, 1965), higher is lighter, and
// steep ground has the colour of rock. What differs:
// - The environment follows the latitude alone (dry belts about 25 degrees, cold from 30 to 50, ice beyond
//   65), as no map of climates is at hand. A wet mountain in a dry belt gets the belt's tint.
// - The scales' metres are stretched so that grass ends at the tree line and grey at the snow line of the
//   latitude (Hermes 1955 in Körner, Alpine Plant Life, 2003, rounded; regions are up to 1,000 m off), and
//   wider where the model's own heights span little of them.
// - Colours are darker and warmer than print on paper, as ground is that light falls on.
// - Hollows have the tint of lower ground, ridges of higher; noise breaks up what would look like contours.
// - Snow above the snow line alone: lower in hollows and on slopes that face the pole, not on walls.
// Heights without a place on the Earth may be anything: they get the humid scales over their own range, and
// no snow.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "terrain/built_in/noise.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// Which colours ground without a picture has: these tints, or those of ground_tones.h.
enum class GroundPalette { Tint, Natural, Hypsometric, Swiss, Grey };

// The ground's place on the Earth, as far as it is known, its vertical scale, and its palette.
struct TintPlace {
    double verticalScale = 1;       // factor from the file's heights to the ground's
    std::vector<double> latitudes;  // radians, evenly from the southern edge to the northern; empty: unknown
    GroundPalette palette = GroundPalette::Tint;
};

// Tree line and snow line, metres above the sea; 0 <= tree <= snow.
struct GrowthLines {
    double tree = 0, snow = 0;
};
// latitude: radians.
GrowthLines growthLines(double latitude);

// Returns whether all samples around a grid position are exactly at the sea's level.
bool isLevelSea(const Heightfield& ground, const glm::dvec2& grid);

class GroundTint {
public:
    // ground must outlive this object.
    GroundTint(const Heightfield& ground, const TintPlace& place) : GroundTint(ground, place, ground) {}
    // Tints a part of a ground, of any spacing, with the colours that it has as a part of the whole, which
    // must outlive this object. place: of the whole.
    GroundTint(const Heightfield& part, const TintPlace& place, const Heightfield& whole);

    // Properties that are stored at the samples and interpolated bilinearly; beyond the ground's edge those
    // of the nearest sample.
    struct Site {
        glm::vec2 gradient{0.0f};  // metres per metre, as for Heightfield::normalAt()
        float hollow = 0;          // -1 on ridges to 1 in hollows
        float broad = 0;           // noise, -1 to 1
        glm::dvec3 normal() const;
    };
    Site siteAt(const glm::dvec2& grid) const;

    // Returns the linear colour without light. height: metres on the ground, NaN in holes; site: at that
    // place.
    glm::vec3 at(const glm::dvec2& grid, double height, const Site& site) const;

    static constexpr double kBytesPerSample = sizeof(Site);

private:
    // Tree line, snow line and colours at a latitude.
    struct Zone {
        GrowthLines lines;
        double poleward = 0;            // y of the direction to the nearer pole: 1, -1, near the equator 0
        std::vector<glm::vec3> colors;  // by height on the colour scale
    };
    double scaleHeight(const GrowthLines& lines, double metres) const;
    // Turns grid coordinates of the part into those of the whole.
    glm::dvec2 inWhole(const glm::dvec2& grid) const { return mFirst + grid * mStep; }

    const Heightfield &mGround, &mWhole;
    glm::dvec2 mFirst{0.0}, mStep{1.0};  // grid of the whole: the first sample; step to the next
    double mUnscale = 1;                 // metres above the sea per metre of the ground
    double mMetresPerStep = 1;           // the wider spacing
    bool mPlaced = false, mSeaFloor = false;
    // Metres, 1/metre: the range of heights of ground with unknown position.
    double mLow = 0, mPerMetre = 0;
    double mStretch = 1, mMiddle = 0, mShift = 0;  // stretching of the scales around a middle; metres
    float mRockFrom = 0.6f, mRockFull = 1.2f;      // slopes, metres per metre
    std::vector<Zone> mZones;                      // evenly from south to north
    std::vector<Site> mSites;
    Noise mFine;
};

}  // namespace stereonav
