// Text in pictures, by stb_truetype from the font of the program. What the font has no letter for is shown as
// U+FFFD, control characters as blanks. Letters stand one after the other as they come: none are joined, and
// none run from right to left.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Letters of one size. Keeps those that it has drawn; not for two threads at once.
class Letters {
public:
    static constexpr int kLeastHeight = 5, kMostHeight = 400;
    // The height in pixels from the top of the highest letter to the foot of the lowest one, within these
    // bounds.
    explicit Letters(int height);
    ~Letters();
    Letters(Letters&&) noexcept;
    Letters& operator=(Letters&&) noexcept;

    int height() const;
    // Returns the width and height of a line of text, pixels.
    glm::dvec2 sizeOf(const std::string& text) const;
    // Draws a line with its top left corner there; what lies beside the picture is left out.
    void draw(const std::string& text, const glm::ivec2& corner, PackedColor ink,
              Plane<PackedColor>& image) const;

private:
    struct Font;
    std::unique_ptr<Font> mFont;
};

// Darkens a plate with round corners, for letters to stand on. low, high, radius: pixels of the picture.
// share: of black, 0 to 255.
void drawPlate(const glm::ivec2& low, const glm::ivec2& high, double radius, unsigned share,
               Plane<PackedColor>& image);

}  // namespace stereonav
