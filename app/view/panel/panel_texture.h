// A picture of the engine as a texture for panels.
#pragma once

#include <optional>

#include "engine/display/gl_object.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

class PanelTexture {
public:
    // Sets the picture; needs the window's context. smooth: interpolates where the picture is enlarged. step:
    // side of the square of pixels that a texel averages, at least 1; remaining pixels at the right and below
    // are left out.
    void set(const Plane<PackedColor>& picture, bool smooth, int step = 1);
    void reset() { mTexture.reset(); }
    bool any() const { return mTexture.has_value(); }
    int width() const { return mWidth; }  // in texels
    int height() const { return mHeight; }
    void* id() const;  // handle for Dear ImGui

private:
    std::optional<GlTexture> mTexture;
    int mWidth = 0, mHeight = 0;
};

}  // namespace stereonav
