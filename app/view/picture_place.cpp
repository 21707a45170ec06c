#include "app/view/picture_place.h"

#include <algorithm>
#include <cmath>

#include "app/view/input.h"

namespace stereonav {
namespace {

// How many parts there are along each axis.
glm::ivec2 partsOf(OutputLayout layout) {
    return {layout == OutputLayout::SideBySide ? 2 : 1, layout == OutputLayout::TopBottom ? 2 : 1};
}

}  // namespace

InterfacePlaces interfacePlaces(const OutputModeInfo& mode) {
    const glm::ivec2 parts = partsOf(mode.layout);
    const glm::vec2 share = 1.0f / glm::vec2(parts);
    InterfacePlaces places;
    places.areas.clear();
    for (int y = 0; y < parts.y; ++y)
        for (int x = 0; x < parts.x; ++x)
            places.areas.push_back(
                {static_cast<float>(x) * share.x, static_cast<float>(y) * share.y, share.x, share.y});
    if (!mode.half) places.size = share;
    return places;
}

PicturePlace picturePlace(const OutputModeInfo& mode, const glm::ivec2& window, const Panels::Rest& rest,
                          const glm::vec2& units) {
    PicturePlace place;
    place.part = glm::max(window / partsOf(mode.layout), glm::ivec2(1));
    const glm::vec2 scale = glm::vec2(place.part) / glm::max(units, glm::vec2(1));
    place.corner = glm::ivec2(glm::round(rest.corner * scale));
    place.corner = glm::min(place.corner, place.part - 1);
    place.size =
        glm::clamp(glm::ivec2(glm::round(rest.size * scale)), glm::ivec2(1), place.part - place.corner);
    return place;
}

glm::ivec2 composedAt(const OutputModeInfo& mode, const PicturePlace& place) {
    return place.size * partsOf(mode.layout);
}

SizeOption eyeSizeAt(const OutputModeInfo& mode, const PicturePlace& place) {
    const glm::ivec2 all = composedAt(mode, place);
    const auto [width, height] = eyeSizeFor(mode.mode, all.x, all.y);
    return {width, height};
}

glm::dvec2 placeInPicture(const OutputModeInfo& mode, const PicturePlace& place, const glm::dvec2& window) {
    const glm::dvec2 inPart = placeInEye(mode.layout, window) * glm::dvec2(place.part);
    return (inPart - glm::dvec2(place.corner)) / glm::dvec2(place.size);
}

}  // namespace stereonav
