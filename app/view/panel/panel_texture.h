// A picture of the engine's as a texture that panels draw.
#pragma once

#include <optional>

#include "engine/display/gl_object.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

class PanelTexture {
public:
    // In the window's context. smooth: neighbours are blended where it is enlarged. step: pixels, along each
    // side, that a texel is the mean of, at least 1; those left over at the right and below are left out.
    void set(const Plane<PackedColor>& picture, bool smooth, int step = 1);
    void reset() { mTexture.reset(); }
    bool any() const { return mTexture.has_value(); }
    int width() const { return mWidth; }  // texels
    int height() const { return mHeight; }
    void* id() const;  // as Dear ImGui takes it

private:
    std::optional<GlTexture> mTexture;
    int mWidth = 0, mHeight = 0;
};

}  // namespace stereonav
