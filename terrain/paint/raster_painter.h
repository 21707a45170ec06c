// Paints a value for each sample of the ground over the colours of a finished eye's picture: what is seen
// from a place, how long the sun shines.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/plane.h"
#include "engine/render/eye_painter.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/fog.h"

namespace stereonav {

// A colour for one of several evenly spaced values from 0 to 1; linear between them.
struct PaintStop {
    glm::vec3 color{0.0f};  // linear
    float share = 0;        // share of this colour in the mix with the picture's, 0 to 1
};

class RasterPainter final : public EyePainter {
public:
    // ground and fog must outlive this object. values: by sample, row 0 southernmost, bilinear between them;
    // clamped to 0 to 1; cells with a NaN are not painted. stops: two or more.
    RasterPainter(const Heightfield& ground, const Fog& fog, Plane<float> values,
                  std::vector<PaintStop> stops);

    void paint(const EyeView& view, EyeImage& image) const override;

private:
    const Heightfield& mGround;
    const Fog& mFog;
    Plane<float> mValues;
    std::vector<PaintStop> mStops;
};

}  // namespace stereonav
