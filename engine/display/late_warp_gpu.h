// The late warp (engine/late) by a fragment shader: from pictures that lie on the graphics processor to
// pictures that stay there.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/display/shader_program.h"
#include "engine/late/late_warp.h"

namespace stereonav {

// Warps two eyes. Needs a current OpenGL 3.3 core context, the same for all calls; one thread.
class LateWarpGpu {
public:
    LateWarpGpu();
    // Returns false where the driver can not draw into eyes of ten bits; nothing else works then.
    bool works() const { return mWorks; }

    // Takes an eye that was cast and prepared, to be warped from now on; uploads it. eye: 0 left, 1 right.
    void take(std::size_t eye, const LateEye& late, const Plane<PackedColor>& color);
    // Draws the eye as `to` sees it. The texture holds it until the next call for this eye: RGB10_A2, row 0
    // on top, alpha where nothing was seen before. take() came first, and `late` is the same.
    GLuint warp(std::size_t eye, const LateEye& late, const EyeView& to);

    // Reads the eye warped last, and where it is uncovered (255) or null. For tests and what is looked at
    // later.
    void read(std::size_t eye, Plane<PackedColor>& image, Plane<std::uint8_t>* uncovered = nullptr) const;

private:
    struct Eye {
        GlTexture color, inverse, plans, image;
        GlFramebuffer framebuffer;
        int width = 0, height = 0;            // size of the picture that was cast
        int across = 0, down = 0;             // number of the plans each way
        int shownWidth = 0, shownHeight = 0;  // size of the new picture
    };
    void sizeImage(Eye& eye, int width, int height);

    ShaderProgram mProgram;
    GlVertexArray mVertices;
    std::array<Eye, 2> mEyes;
    std::vector<LatePlan> mPlans;
    std::vector<float> mTexels;  // the plans, as they are uploaded: each its LatePlan's three numbers
    bool mWorks = true;
};

}  // namespace stereonav
