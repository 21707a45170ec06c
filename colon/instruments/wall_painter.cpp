#include "colon/instruments/wall_painter.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"

namespace stereonav {

void WallPainter::paint(const EyeView& view, EyeImage& image) const {
    if (image.viewDepth.empty()) return;
    const glm::vec3 luminance(0.2126f, 0.7152f, 0.0722f);
    parallelFor(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            const float depth = image.viewDepth.at(x, y);
            if (!(depth > 0) || !std::isfinite(depth)) continue;
            const float mark = mMarks->at(view.pointAt(x + 0.5, y + 0.5, depth));
            if (mark <= 0.35f) continue;
            const float share = 0.8f * glm::smoothstep(0.35f, 0.65f, mark);
            PackedColor& color = image.color.at(x, y);
            const glm::vec3 was = unpackColor(color);
            color = packColor(glm::mix(was, glm::dot(was, luminance) * mTint, share));
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
