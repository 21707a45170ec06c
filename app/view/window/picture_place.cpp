#include "app/view/window/picture_place.h"

#include <algorithm>
#include <cmath>

#include "app/view/input.h"

namespace stereonav {
namespace {

constexpr int kUnit = 1 << 14;  // size in pixels of a picture from which shares are computed

bool oneArea(const std::array<EyeArea, 2>& areas) {
    return areas[0] == areas[1];
}

}  // namespace

InterfacePlaces interfacePlaces(const OutputModeInfo& mode) {
    const auto areas = eyeAreas(mode.mode, kUnit, kUnit);
    InterfacePlaces places;
    places.areas.clear();
    for (const EyeArea& area : areas) {
        const auto share = [](int pixels) { return static_cast<float>(pixels) / kUnit; };
        places.areas.push_back({share(area.x), share(area.y), share(area.width), share(area.height)});
        if (oneArea(areas)) break;
    }
    if (!mode.half) places.size = {places.areas.front().width, places.areas.front().height};
    return places;
}

bool partsCover(OutputMode mode, const SizeOption& window) {
    const auto areas = eyeAreas(mode, window.width, window.height);
    const auto pixels = [](int width, int height) { return static_cast<long long>(width) * height; };
    long long covered = pixels(areas[0].width, areas[0].height);
    if (!oneArea(areas)) covered += pixels(areas[1].width, areas[1].height);
    return covered == pixels(window.width, window.height);
}

PicturePlace picturePlace(const OutputModeInfo& mode, const glm::ivec2& window, const ShownPanels::Rest& rest,
                          const glm::vec2& units) {
    const EyeArea area = eyeAreas(mode.mode, window.x, window.y)[0];
    PicturePlace place;
    place.part = glm::max(glm::ivec2(area.width, area.height), glm::ivec2(1));
    const glm::vec2 scale = glm::vec2(place.part) / glm::max(units, glm::vec2(1));
    place.corner = glm::ivec2(glm::round(rest.corner * scale));
    place.corner = glm::min(place.corner, place.part - 1);
    place.size =
        glm::clamp(glm::ivec2(glm::round(rest.size * scale)), glm::ivec2(1), place.part - place.corner);
    return place;
}

glm::ivec2 composedAt(const OutputModeInfo& mode, const PicturePlace& place) {
    if (mode.half) {
        // Both parts of the window together, side by side or one above the other.
        const bool beside = mode.layout == OutputLayout::SideBySide;
        return place.size * glm::ivec2(beside ? 2 : 1, beside ? 1 : 2);
    }
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
