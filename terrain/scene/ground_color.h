// The ground's colour texture: an image laid over the elevation model, or a tint by height. The light
// of the sun does not depend on the eye, so it is baked in here and filtered with the colour.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "engine/base/progress.h"
#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/ground_tint.h"
#include "terrain/scene/laid_picture.h"

namespace stereonav {

// Colours of ground, and where they come from.
struct GroundColor {
    ColorTexture texture;
    std::string source;     // "image winter.jpg 457x499 over the same extent", ...
    bool holdsSun = false;  // some of it is lit by the look's sun
};

// Light on ground as a factor on its colour: 1 on level ground, less on slopes turned away, down to
// the ambient share where the sun does not reach (Lambert), everywhere once it has set.
class GroundLight {
public:
    explicit GroundLight(const TerrainLook& look);
    float at(const glm::dvec3& unitNormal) const;  // the factor, 0 or more
    const glm::dvec3& direct() const { return mDirect; }

private:
    glm::dvec3 mDirect{0.0};  // towards the sun, as long as its light is strong
    double mAmbient = 0;      // factor where the sun does not reach
};

// Returns the bytes that tintedGround() holds at once for ground of `samples` samples.
double bytesOfTint(double samples);

// Returns tints by height, place and slope (ground_tint.h), lit; two texels a sample each way. Throws
// Cancelled.
GroundColor tintedGround(const Heightfield& ground, const TerrainLook& look, const TintPlace& place,
                         Progress& progress);

// Returns tints of a part of a ground, `density` texels a sample each way; place: that of the whole.
ColorTexture tintedPart(const Heightfield& part, const Heightfield& whole, const TerrainLook& look,
                        const TintPlace& place, double density, Progress& progress);

// The colours of ground under a picture, whole or in parts.
struct PicturedGround {
    std::shared_ptr<const LaidPicture> picture;
    TerrainLook look;
    TintPlace tint;          // where the picture does not cover it
    bool perSample = false;  // its light is that of every sample: a part has a texel a sample at least
};

// Lays an image over the ground. One with a georeference (its own, or a world file's beside it, then in the
// elevation model's system) is laid where it belongs; one without covers the extent of the elevation file,
// whatever its aspect. Masked and uncovered places get the tint. 8 or 16 bits, gray, colour or palette, taken
// as sRGB; texels as fine as the image's pixels, 2^26 of them and mostDensity a sample each way at most.
// Throws Error that names the image, among others where it does not overlap; Cancelled.
GroundColor picturedGround(const Heightfield& ground, const PicturedGround& pictured, double mostDensity,
                           Progress& progress);
// Returns the colours of a part of a ground, of any level: texels as fine as the picture's pixels,
// `mostTexels` at most, or a texel a sample where that is more. Tint alone beyond the picture. From any
// thread. Throws Error where the picture can not be read.
ColorTexture picturedPart(const Heightfield& part, const Heightfield& whole, const PicturedGround& pictured,
                          double mostTexels);

}  // namespace stereonav
