#include "app/output/place_labels.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <utility>

#include "engine/text/utf8.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostLabels = 40, kLongestLabel = 32;  // labels, and letters of one
constexpr double kNearest = -0.03;  // parallax, share of the width: nearer labels are left out

struct Box {
    glm::dvec2 low, high;
    bool meets(const Box& other) const {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
    }
};

bool isTaken(const std::vector<Box>& taken, const Box& box) {
    return std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return other.meets(box); });
}

// Returns the text's corner relative to the mark: above the mark, or below where there is no room, and
// shifted sideways so that both eyes show the whole text.
std::optional<glm::dvec2> placed(const EyeMark& mark, const glm::dvec2& size, const glm::dvec2& picture,
                                 double margin) {
    const double from = std::min(mark.left.x, mark.right.x), to = std::max(mark.left.x, mark.right.x);
    const double lowest = margin - from, highest = picture.x - margin - size.x - to;
    if (lowest > highest) return std::nullopt;
    double y = -2 * margin - size.y;
    if (mark.left.y + y < margin) y = 2 * margin;
    if (mark.left.y + y + size.y > picture.y - margin) return std::nullopt;
    return glm::dvec2(std::clamp(-size.x / 2, lowest, highest), y);
}

}  // namespace

std::vector<PlaceLabel> labelsInView(const StereoViews& views, const Plane<float>& viewDepth,
                                     const std::vector<LabelledPlace>& places, const TextSize& sizeOf,
                                     double margin, const glm::ivec2& guard) {
    std::vector<PlaceLabel> labels;
    if (places.empty()) return labels;
    const glm::dvec2 picture(views.left.width, views.left.height);
    std::vector<std::pair<PointMark, const LabelledPlace*>> seen;
    for (const LabelledPlace& place : places) {
        const auto point = markOf(views, viewDepth, place.world, guard);
        if (!point || point->mark.right.x - point->mark.left.x < kNearest * picture.x) continue;
        seen.emplace_back(*point, &place);
    }
    std::stable_sort(seen.begin(), seen.end(),
                     [](const auto& a, const auto& b) { return a.first.depth < b.first.depth; });
    std::array<std::vector<Box>, 2> taken;  // boxes of the labels so far in each eye
    for (const auto& [point, place] : seen) {
        if (labels.size() == kMostLabels) break;
        PlaceLabel label{point.mark, firstLetters(place->name, kLongestLabel), {}};
        const glm::dvec2 size = sizeOf(label.text);
        const auto at = placed(label.mark, size, picture, margin);
        if (!at) continue;
        label.textAt = *at;
        const auto boxAt = [&](const glm::dvec2& mark) {
            return Box{mark + *at - margin, mark + *at + size + margin};
        };
        const std::array boxes{boxAt(label.mark.left), boxAt(label.mark.right)};
        if (isTaken(taken[0], boxes[0]) || isTaken(taken[1], boxes[1])) continue;
        for (std::size_t eye : {0u, 1u}) taken[eye].push_back(boxes[eye]);
        labels.push_back(std::move(label));
    }
    return labels;
}

}  // namespace stereonav
