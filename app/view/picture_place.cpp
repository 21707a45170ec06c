#include "app/view/picture_place.h"

#include <algorithm>
#include <cmath>

#include "app/view/input.h"

namespace stereonav {
namespace {

// How many parts there are along each axis; of frame-packed ones two, with a gap between them.
glm::ivec2 partsOf(OutputLayout layout) {
    return {layout == OutputLayout::SideBySide ? 2 : 1,
            layout == OutputLayout::TopBottom || layout == OutputLayout::FramePacked ? 2 : 1};
}

}  // namespace

InterfacePlaces interfacePlaces(const OutputModeInfo& mode) {
    const glm::ivec2 parts = partsOf(mode.layout);
    const bool packed = mode.layout == OutputLayout::FramePacked;
    const glm::vec2 share = packed ? glm::vec2(1, kPackedEye) : 1.0f / glm::vec2(parts);
    const glm::vec2 step = packed ? 1.0f - share : share;
    InterfacePlaces places;
    places.areas.clear();
    for (int y = 0; y < parts.y; ++y)
        for (int x = 0; x < parts.x; ++x)
            places.areas.push_back(
                {static_cast<float>(x) * step.x, static_cast<float>(y) * step.y, share.x, share.y});
    if (!mode.half) places.size = share;
    return places;
}

PicturePlace picturePlace(const OutputModeInfo& mode, const glm::ivec2& window, const Panels::Rest& rest,
                          const glm::vec2& units) {
    PicturePlace place;
    const EyeArea part = eyeAreas(mode.mode, window.x, window.y)[0];
    place.part = glm::max(glm::ivec2(part.width, part.height), glm::ivec2(1));
    const glm::vec2 scale = glm::vec2(place.part) / glm::max(units, glm::vec2(1));
    place.corner = glm::ivec2(glm::round(rest.corner * scale));
    place.corner = glm::min(place.corner, place.part - 1);
    place.size =
        glm::clamp(glm::ivec2(glm::round(rest.size * scale)), glm::ivec2(1), place.part - place.corner);
    return place;
}

glm::ivec2 composedAt(const OutputModeInfo& mode, const PicturePlace& place) {
    if (mode.layout != OutputLayout::FramePacked) return place.size * partsOf(mode.layout);
    const auto [width, height] = composedSize(mode.mode, place.size.x, place.size.y);
    return {width, height};
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
