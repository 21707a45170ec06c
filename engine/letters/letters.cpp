#include "engine/letters/letters.h"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/letters/blend.h"
#include "engine/letters/letter_font.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

// Letters begin at quarters of a pixel: at whole ones small text has uneven gaps.
constexpr int kLetterSteps = 4;

struct DrawnLetter {
    glm::ivec2 low{0}, size{0};  // pixels from where the letter begins on its line
    std::vector<unsigned char> coverage;
};

// The font's number of a letter.
int glyphOf(const stbtt_fontinfo& font, char32_t code) {
    if (code < 0x20 || code == 0x7f) code = ' ';
    const int glyph = stbtt_FindGlyphIndex(&font, static_cast<int>(code));
    return glyph != 0 ? glyph : stbtt_FindGlyphIndex(&font, static_cast<int>(kNoLetter));
}

// Returns the range of a letter's rows or columns that lie in a picture of `size`.
std::pair<int, int> within(int first, int count, int size) {
    return {std::max(0, -first), std::min(count, size - first)};
}

}  // namespace

struct Letters::Font {
    explicit Font(int pixels) : height(pixels) {
        if (!stbtt_InitFont(&info, letterFontFile().data(), 0))
            throw Error("DejaVu Sans", "", "the program's font can not be read", "build the program again");
        scale = stbtt_ScaleForPixelHeight(&info, static_cast<float>(height));
        int ascent = 0, descent = 0, gap = 0;
        stbtt_GetFontVMetrics(&info, &ascent, &descent, &gap);
        baseline = static_cast<int>(std::lround(static_cast<float>(ascent) * scale));
    }

    // Calls each(letter's number, pixels from the text's beginning); gives where the text ends.
    template <typename Each>
    double forEach(const std::string& text, const Each& each) const {
        double pen = 0;
        for (std::size_t at = 0; at < text.size();) {
            const Letter letter = letterAt(text, at);
            at += letter.bytes;
            const int glyph = glyphOf(info, letter.code);
            each(glyph, pen);
            int advance = 0, bearing = 0;
            stbtt_GetGlyphHMetrics(&info, glyph, &advance, &bearing);
            pen += static_cast<double>(static_cast<float>(advance) * scale);
        }
        return pen;
    }

    const DrawnLetter& drawn(int glyph, int step) {
        const auto [at, isNew] = letters.try_emplace({glyph, step});
        DrawnLetter& letter = at->second;
        if (!isNew) return letter;
        const float shift = static_cast<float>(step) / kLetterSteps;
        glm::ivec2 high(0);
        stbtt_GetGlyphBitmapBoxSubpixel(&info, glyph, scale, scale, shift, 0, &letter.low.x, &letter.low.y,
                                        &high.x, &high.y);
        letter.size = glm::max(high - letter.low, glm::ivec2(0));
        letter.coverage.resize(static_cast<std::size_t>(letter.size.x) *
                               static_cast<std::size_t>(letter.size.y));
        if (!letter.coverage.empty())
            stbtt_MakeGlyphBitmapSubpixel(&info, letter.coverage.data(), letter.size.x, letter.size.y,
                                          letter.size.x, scale, scale, shift, 0, glyph);
        return letter;
    }

    stbtt_fontinfo info{};
    int height = 0, baseline = 0;  // pixels; baseline: below the line's top
    float scale = 0;               // pixels of a unit of the font
    std::map<std::pair<int, int>, DrawnLetter> letters;
};

Letters::Letters(int height) : mFont(std::make_unique<Font>(std::clamp(height, kLeastHeight, kMostHeight))) {}
Letters::~Letters() = default;
Letters::Letters(Letters&&) noexcept = default;
Letters& Letters::operator=(Letters&&) noexcept = default;

int Letters::height() const {
    return mFont->height;
}

glm::dvec2 Letters::sizeOf(const std::string& text) const {
    return {std::ceil(mFont->forEach(text, [](int, double) {})), mFont->height};
}

void Letters::draw(const std::string& text, const glm::ivec2& corner, PackedColor ink,
                   Plane<PackedColor>& image) const {
    mFont->forEach(text, [&](int glyph, double pen) {
        const auto steps = static_cast<int>(std::lround(pen * kLetterSteps));
        const DrawnLetter& letter = mFont->drawn(glyph, steps % kLetterSteps);
        const glm::ivec2 at = corner + glm::ivec2(steps / kLetterSteps, mFont->baseline) + letter.low;
        const auto [left, right] = within(at.x, letter.size.x, image.width());
        const auto [top, bottom] = within(at.y, letter.size.y, image.height());
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                PackedColor& pixel = image.at(at.x + x, at.y + y);
                pixel = blended(pixel, ink, letter.coverage[static_cast<std::size_t>(y) * letter.size.x + x]);
            }
    });
}

void drawPlate(const glm::ivec2& low, const glm::ivec2& high, double radius, unsigned share,
               Plane<PackedColor>& image) {
    const glm::dvec2 middle = 0.5 * glm::dvec2(low + high), half = 0.5 * glm::dvec2(high - low);
    const double round = std::clamp(radius, 0.0, std::max(0.0, std::min(half.x, half.y)));
    const int right = std::min(high.x, image.width()), bottom = std::min(high.y, image.height());
    for (int y = std::max(low.y, 0); y < bottom; ++y)
        for (int x = std::max(low.x, 0); x < right; ++x) {
            // Within the plate less its rounding, and from there to the pixel.
            const glm::dvec2 out =
                glm::max(glm::abs(glm::dvec2(x + 0.5, y + 0.5) - middle) - half + round, 0.0);
            const double inside = std::clamp(round + 0.5 - glm::length(out), 0.0, 1.0);
            PackedColor& pixel = image.at(x, y);
            pixel = blended(pixel, 0, static_cast<unsigned>(std::lround(inside * share)));
        }
}

}  // namespace stereonav
