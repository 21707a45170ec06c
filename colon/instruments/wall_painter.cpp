#include "colon/instruments/wall_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr float kFaintest = 0.35f, kFull = 0.65f;  // marks: from here on they are drawn; in full

// The mark at the place that a pixel shows. A warped pixel at a silhouette lies between two left ones, in
// depth too: in the air, off both walls. It is marked as the pixel beside it that is nearest in depth.
float markShown(const WallMarks& marks, const EyeView& view, const Plane<float>& depths, int x, int y) {
    const float depth = depths.at(x, y);
    const float own = marks.at(view.pointAt(x + 0.5, y + 0.5, depth));
    if (!(own < 0)) return own;
    if (x == 0 || x + 1 == depths.width()) return own;
    const float before = depths.at(x - 1, y), after = depths.at(x + 1, y);
    if (!(std::min(before, after) > 0 && std::min(before, after) < depth && depth < std::max(before, after)))
        return own;
    const bool first = std::abs(before - depth) < std::abs(after - depth);
    const float nearest = first ? before : after;
    if (!std::isfinite(nearest)) return own;
    return marks.at(view.pointAt(first ? x - 0.5 : x + 1.5, y + 0.5, nearest));
}

}  // namespace

glm::vec3 WallPainter::tinted(float mark, const glm::vec3& color) const {
    const glm::vec3 luminance(0.2126f, 0.7152f, 0.0722f);
    return glm::mix(color, glm::dot(color, luminance) * mTint,
                    0.8f * glm::smoothstep(kFaintest, kFull, mark));
}

glm::vec3 WallPainter::paintPlace(const glm::dvec3& world, const glm::vec3& color) const {
    const float mark = mMarks->at(world);
    return mark > kFaintest ? tinted(mark, color) : color;
}

void WallPainter::paint(const EyeView& view, EyeImage& image) const {
    if (image.viewDepth.empty()) return;
    parallelFor(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            const float depth = image.viewDepth.at(x, y);
            if (!(depth > 0) || !std::isfinite(depth)) continue;
            const float mark = markShown(*mMarks, view, image.viewDepth, x, y);
            if (!(mark > kFaintest)) continue;
            PackedColor& color = image.color.at(x, y);
            color = packColor(tinted(mark, unpackColor(color)));
        }
    });
}

std::shared_ptr<const EyePainter> wallPainter(const WallMesh& wall, const WallNeighbours& neighbours,
                                              const VolumeFrame& frame, std::vector<float> marks,
                                              const glm::vec3& tint) {
    constexpr int kSoftRounds = 2;
    marks = softened(neighbours, std::move(marks), kSoftRounds);
    return std::make_shared<WallPainter>(std::make_shared<const WallMarks>(wall, frame, marks), tint);
}

}  // namespace stereonav
