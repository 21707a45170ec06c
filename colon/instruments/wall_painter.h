// Tints a lumen's wall in finished pictures, where the wall is marked.
#pragma once

#include <memory>
#include <vector>

#include "colon/instruments/wall_marks.h"
#include "engine/render/eye_painter.h"

namespace stereonav {

class WallPainter final : public EyePainter {
public:
    // tint: linear RGB of a white wall with mark 1; light and shade of the wall stay. The tint begins at mark
    // 0.35 and is full from 0.65 on.
    WallPainter(std::shared_ptr<const WallMarks> marks, const glm::vec3& tint)
        : mMarks(std::move(marks)), mTint(tint) {}

    void paint(const EyeView& view, EyeImage& image) const override;
    glm::vec3 paintPlace(const glm::dvec3& world, const glm::vec3& color) const override;

private:
    glm::vec3 tinted(float mark, const glm::vec3& color) const;

    std::shared_ptr<const WallMarks> mMarks;
    glm::vec3 mTint;  // linear RGB
};

// Tints of unseen wall and of wall under fluid: linear RGB, factors on luminance.
inline const glm::vec3 kUnseenTint(0.1f, 0.55f, 2.6f), kFluidTint(0.1f, 1.5f, 0.25f);

// Returns a painter of marks that are given by vertex, 0 to 1, with softened borders.
std::shared_ptr<const EyePainter> wallPainter(const WallMesh& wall, const WallNeighbours& neighbours,
                                              const VolumeFrame& frame, std::vector<float> marks,
                                              const glm::vec3& tint);

}  // namespace stereonav
