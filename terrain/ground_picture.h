// The part of an image file that a texture needs, read through GDAL at the texture's density.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "terrain/gdal_session.h"

namespace stereonav {

// Pixel coordinates of the image: [min, max).
struct PixelWindow {
    int xMin = 0, yMin = 0, xMax = 0, yMax = 0;
};

class GroundPicture {
public:
    // Reads the window, averaged down by the factor `shrink` (>= 1) each way. Throws Error.
    GroundPicture(GDALDataset& dataset, GdalMessages& messages, const std::filesystem::path& file,
                  const PixelWindow& window, const glm::dvec2& shrink);

    struct Sample {
        glm::vec3 color{0.0f};  // linear
        float cover = 0;        // share of the bilinear weight on pixels that hold colour
    };
    // At pixel coordinates of the whole image.
    Sample at(const glm::dvec2& pixel) const;

private:
    glm::dvec2 mOrigin{0.0}, mShrink{1.0};
    Plane<PackedColor> mColor;
    Plane<unsigned char> mMask;  // 0: no colour here; empty: colour everywhere
};

}  // namespace stereonav
