// Pictures of the real program as linear light, to be held against closed forms.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/image/image_file.h"
#include "tests/app/program.h"

namespace stereonav::test {

// Values of both eyes side by side, row by row.
using Shown = LinearImage;

inline glm::vec3 sumOf(const Shown& shown) {
    glm::vec3 sum(0);
    for (const glm::vec3& pixel : shown.pixels) sum += pixel;
    return sum;
}

// The picture with each pixel made of those at the same place in others.
inline Shown mapped(const Shown& a, const Shown& b,
                    const std::function<glm::vec3(const glm::vec3&, const glm::vec3&)>& of) {
    Shown result = a;
    for (std::size_t n = 0; n < a.pixels.size(); ++n) result.pixels[n] = of(a.pixels[n], b.pixels[n]);
    return result;
}

inline Shown mirrored(const Shown& shown) {
    Shown result = shown;
    for (int y = 0; y < shown.height; ++y) {
        const auto row = result.pixels.begin() + static_cast<std::ptrdiff_t>(y) * shown.width;
        std::reverse(row, row + shown.width);
    }
    return result;
}

// Steps of 255 of a display's, near enough: what a file keeps.
inline float levels(float linear) {
    return 255 * std::sqrt(std::max(linear, 0.0f));
}

inline void expectAlike(const Shown& found, const Shown& wanted, float most, const char* what) {
    ASSERT_EQ(found.pixels.size(), wanted.pixels.size()) << what;
    for (std::size_t n = 0; n < found.pixels.size(); ++n)
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(levels(found.pixels[n][c]), levels(wanted.pixels[n][c]), most)
                << what << ": column " << n % static_cast<std::size_t>(found.width) << ", row "
                << n / static_cast<std::size_t>(found.width) << ", channel " << c;
}

// No channel of any pixel of `less` is brighter.
inline void expectNoBrighter(const Shown& less, const Shown& more, const char* what) {
    ASSERT_EQ(less.pixels.size(), more.pixels.size()) << what;
    for (std::size_t n = 0; n < less.pixels.size(); ++n)
        for (int c = 0; c < 3; ++c)
            ASSERT_LE(levels(less.pixels[n][c]), levels(more.pixels[n][c]) + 1.6f) << what << " " << n;
}

}  // namespace stereonav::test
