// What is left out of a highlight is too little to be seen, in double precision, wherever lamp, eye and wall
// are.
#include "engine/volume/highlight_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace stereonav {
namespace {

// Steps of a packed channel that the highlight adds, and whether it is left out.
struct Highlight {
    double steps = 0;
    bool leftOut = false;
};

// Returns the kernels' light at a place, without their shortcut.
Highlight highlightAt(const VolumeLook& look, double channel, const glm::dvec3& toLamp,
                      const glm::dvec3& toEye, const glm::dvec3& normal) {
    const double distance = glm::length(toLamp);
    const glm::dvec3 lamp = toLamp / distance;
    const double cosine = glm::dot(normal, lamp);
    const double reaches = look.falloff > 0 ? 1 / (1 + std::pow(distance / look.falloff, 2)) : 1;
    const glm::dvec3 half = lamp + glm::normalize(toEye);
    const double aligned = std::max(0.0, glm::dot(normal, half) / std::max(glm::length(half), 1e-9));
    const double highlight =
        cosine > 0 ? look.specular * std::pow(aligned, double{look.shininess}) * reaches : 0;
    const double ambient = look.ambient * (1 + look.varyingAmbient * normal.z);
    const double light = channel * (look.diffuse * std::max(0.0, cosine) + ambient) * reaches;
    const double away = glm::length(toLamp - toEye);
    return {1023 * (std::sqrt(light + highlight) - std::sqrt(light)),
            !(cosine > 0 && cosine + away / distance >= faintHighlightCosine(look))};
}

TEST(HighlightBound, WhatIsLeftOutIsNotSeen) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1), both(-1, 1);
    const auto direction = [&] {
        glm::dvec3 d;
        do d = {both(random), both(random), both(random)};
        while (glm::length(d) < 0.05 || glm::length(d) > 1);
        return glm::normalize(d);
    };
    int leftOut = 0, all = 0;
    double most = 0;
    for (int n = 0; n < 40'000; ++n) {
        VolumeLook look;
        look.specular = static_cast<float>(std::pow(10, -2 + 3 * share(random)));
        look.shininess = static_cast<float>(std::pow(10, 2.5 * share(random)));
        look.ambient = n % 3 ? static_cast<float>(share(random)) : 0.0f;
        look.varyingAmbient = n % 2 ? static_cast<float>(share(random)) : 0.0f;
        look.falloff = n % 5 ? 0.06f : 0.0f;
        const double distance = std::pow(10, -3 + 3 * share(random));  // a millimetre to a metre
        const double away = std::pow(10, -4 + 3 * share(random));      // a tenth of it to ten centimetres
        const glm::dvec3 toLamp = distance * direction(), toEye = toLamp + away * direction();
        if (glm::length(toEye) < 1e-6) continue;
        const double darkest = std::min({look.surface.x, look.surface.y, look.surface.z});
        const Highlight h = highlightAt(look, darkest, toLamp, toEye, direction());
        ++all;
        if (!h.leftOut) continue;
        ++leftOut;
        most = std::max(most, h.steps);
    }
    EXPECT_LE(most, kFaintHighlight);
    EXPECT_GT(most, 0.2 * kFaintHighlight) << "nothing came near the bound";
    EXPECT_GT(leftOut, all / 2) << "it is there to leave out what it can";
}

TEST(HighlightBound, OfTheUsualLook) {
    VolumeLook look;
    EXPECT_NEAR(faintHighlightCosine(look), 0.746, 0.002);
    look.transfer = TransferFunction({{0, {0, 0, 0}, 0}, {1, {1, 1, 1}, 1}}, 0.001, "");
    EXPECT_LT(faintHighlightCosine(look), 0.6) << "what is seen may be black";
    look.specular = 0;
    EXPECT_EQ(faintHighlightCosine(look), 0.0);
    look.specular = 1e-9f;
    EXPECT_GT(faintHighlightCosine(look), 1.0) << "never seen";
}

}  // namespace
}  // namespace stereonav
