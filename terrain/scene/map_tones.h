// Palettes of maps for ground without a picture, over the ground's own range of heights.
//
// hypsometric: tints by height as atlases have them, from green over yellow and brown to white, without steps
// between them. swiss: after Imhof 1965 (Kartographische Geländedarstellung, chapters on shading and on
// colour) and Jenny and Hurni 2006 (Swiss-style colour relief shading modulated by elevation and by exposure
// to illumination, Cartographic Journal 43): sides in the light from the north-west are yellowish, sides
// turned away bluish, most so at the summits; lowlands are light, bluish and of little contrast, as seen
// through air. grey: one grey.
#pragma once

#include <string>

#include "engine/render/paint_legend.h"
#include "terrain/scene/ground_shape.h"
#include "terrain/scene/ground_tones.h"

namespace stereonav {

class MapTones final : public GroundTones {
public:
    // place.palette: Hypsometric, Swiss or Grey. Both grounds must outlive this; place: the whole's.
    MapTones(const Heightfield& part, const TintPlace& place, const Heightfield& whole);

    GroundTone at(const glm::dvec2& grid, double height) const override;

private:
    const GroundPalette mPalette;
    GroundShape mShape;
    double mLow = 0, mPerMetre = 0;  // metres as the ground has them; 1/metre
};

// Returns the linear colour at a share of the range of heights, 0 to 1.
glm::vec3 hypsometricColor(float share);
// Returns the same of swiss ground that lies so. normal: unit.
glm::vec3 swissColor(float share, const glm::dvec3& normal);

// Returns what a palette's colours mean over ground from low to high, metres of the file; nothing but for
// Hypsometric.
Legend legendOfPalette(GroundPalette palette, double low, double high);

}  // namespace stereonav
