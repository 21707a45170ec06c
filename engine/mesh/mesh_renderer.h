// A mesh as a scene for rays: lit by a sun, in front of a plain background.
#pragma once

#include "engine/mesh/mesh_caster.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

// Returns the linear colour for a ray that meets nothing: grey, darker upwards. direction: of any length but
// 0.
glm::vec3 meshBackground(const glm::dvec3& direction);

class MeshRenderer final : public EyeRenderer {
public:
    explicit MeshRenderer(MeshCaster caster) : mCaster(std::move(caster)) {}

    const MeshCaster& caster() const { return mCaster; }
    const MeshLight& light() const { return mLight; }
    void setLight(const MeshLight& light) { mLight = light; }  // no picture may be cast meanwhile

    int tileCount(const EyeView& view) const override;
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override;
    void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override;
    bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                          double parallaxScale) const override;

private:
    void castBatch(const MeshRays& rays, const EyeView& view, std::span<const PixelIndex> pixels,
                   EyeImage& image) const;

    MeshCaster mCaster;
    MeshLight mLight;
};

}  // namespace stereonav
