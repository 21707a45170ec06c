// The part of an image file that a texture needs, at the texture's density; raster_file.h reads it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Pixel coordinates of the image: [min, max).
struct PixelWindow {
    int xMin = 0, yMin = 0, xMax = 0, yMax = 0;
};

// Stored values that are shown as black and as white.
struct PictureTone {
    double black = 0, white = 255;   // stored values
    std::vector<std::string> notes;  // guesses of the tone, a line each
};

// A part of an image, perhaps shrunk.
class GroundPicture {
public:
    struct Parts {
        // Pixels of the whole image: corner of the first pixel; width and height of a pixel.
        glm::dvec2 origin{0.0}, shrink{1.0};
        Plane<PackedColor> color;
        Plane<unsigned char> mask;  // 0: no colour here; empty: colour everywhere
    };
    explicit GroundPicture(Parts parts);

    struct Sample {
        glm::vec3 color{0.0f};  // linear
        float cover = 0;        // share of the bilinear weight on pixels that hold colour, 0 to 1
    };
    // Returns the bilinear colour at pixel coordinates of the whole image.
    Sample at(const glm::dvec2& pixel) const;

private:
    Parts mParts;
};

}  // namespace stereonav
