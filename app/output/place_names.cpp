#include "app/output/place_names.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "app/output/place_labels.h"

namespace stereonav {
namespace {

// Sizes as in the window, in heights of letters; the clearance of the mark is in pixels, as marks have the
// same size in every picture.
constexpr double kNameMargin = 0.3, kNamePlate = 0.25, kNameRound = 0.2, kMarkClear_px = 4;
constexpr unsigned kPlateShare = 170;  // opacity of the black plate, of 255

std::vector<LabelledPlace> namedAmong(const std::vector<PaintedPlace>& places) {
    std::vector<LabelledPlace> named;
    for (const PaintedPlace& place : places)
        if (!place.name.empty()) named.push_back({place.name, place.world});
    return named;
}

void drawName(const Letters& letters, const PlaceLabel& label, const glm::dvec2& mark,
              Plane<PackedColor>& eye) {
    const glm::ivec2 corner(glm::round(mark + label.textAt));
    const glm::ivec2 size(letters.sizeOf(label.text));
    const int aside = static_cast<int>(std::lround(kNamePlate * letters.height()));
    drawPlate(corner - glm::ivec2(aside, 0), corner + size + glm::ivec2(aside, 0),
              kNameRound * letters.height(), kPlateShare, eye);
    letters.draw(label.text, corner, packColor(glm::vec3(1)), eye);
}

}  // namespace

int PlaceNames::letterHeight(int pictureHeight) {
    return std::clamp((pictureHeight + 20) / 40, Letters::kLeastHeight, Letters::kMostHeight);
}

void PlaceNames::draw(const std::vector<PaintedPlace>& places, const StereoViews& views, EyePair& frame) {
    const std::vector<LabelledPlace> named = namedAmong(places);
    if (named.empty()) return;
    const int height = letterHeight(views.left.height);
    if (!mLetters || mLetters->height() != height) mLetters.emplace(height);
    const auto sizeOf = [&](const std::string& text) { return mLetters->sizeOf(text); };
    const double margin = std::max(kNameMargin * height, kMarkClear_px);
    for (const PlaceLabel& label : labelsInView(views, frame.left.viewDepth, named, sizeOf, margin)) {
        drawName(*mLetters, label, label.mark.left, frame.left.color);
        drawName(*mLetters, label, label.mark.right, frame.right.color);
    }
}

}  // namespace stereonav
