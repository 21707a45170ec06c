// Eyes that a layout shows unchanged, pixel for pixel: the CPU makes the screen's bytes, which are copied
// into the window. Where the processor draws (llvmpipe) that takes a quarter of the time of the composing
// shader.
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
    // Takes an eye, 0 or 1; its colours become sRGB bytes, as in files.
    void upload(std::size_t eye, const Plane<PackedColor>& colors);
    // Copies into the current framebuffer; x, y: the picture's lower left corner. Returns false, having drawn
    // nothing, where the driver can not copy from such a texture.
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
