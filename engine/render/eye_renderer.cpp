#include "engine/render/eye_renderer.h"

#include "engine/base/parallel.h"

namespace stereonav {

void renderEye(const EyeRenderer& renderer, const EyeView& view, EyeImage& image) {
    parallelFor(renderer.tileCount(view), [&](int tile) { renderer.renderTile(view, tile, image); });
}

}  // namespace stereonav
