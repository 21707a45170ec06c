// Eyes that a layout shows as they are, pixel for pixel: bytes as the screen has them, made by the processor
// and copied into the window. Where the processor draws (llvmpipe) that takes a quarter of the time of the
// shader that composes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Copies eyes into the window. In one context.
class PlainEyes {
public:
    // Takes an eye, 0 or 1; sRGB bytes are made of its colours, as files have them.
    void upload(std::size_t eye, const Plane<PackedColor>& colors);
    // Copies into the framebuffer that is drawn into: x, y of the picture's lower left corner. Returns false
    // where the driver can not copy from such a texture; then nothing was drawn.
    bool copy(std::size_t eye, int x, int y) const;

private:
    struct Store {
        GlTexture texture;
        GlFramebuffer framebuffer;
        int width = 0, height = 0;
        bool complete = false;
    };
    std::array<std::unique_ptr<Store>, 2> mStores;
    std::vector<std::uint32_t> mBytes;
};

}  // namespace stereonav
