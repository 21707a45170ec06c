// The late warp (engine/late) in a fragment shader; its input and output pictures stay on the graphics card.
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

    // Takes an eye's picture, cast and prepared, and uploads it; it is warped until the next one is taken.
    // eye: 0 left, 1 right.
    void take(std::size_t eye, const LateEye& late, const Plane<PackedColor>& color);
    // Draws the eye as seen from `to`; take() must have been called with the same `late`. The returned
    // texture holds the picture until the next call for this eye: RGB10_A2, row 0 on top, alpha set where
    // nothing was seen before.
    GLuint warp(std::size_t eye, const LateEye& late, const EyeView& to);

    // Reads the picture that was warped last. uncovered, if not null: 255 where nothing was seen before. For
    // tests, and for measures taken after the flight.
    void read(std::size_t eye, Plane<PackedColor>& image, Plane<std::uint8_t>* uncovered = nullptr) const;

private:
    struct Eye {
        GlTexture color, inverse, plans, image;
        GlFramebuffer framebuffer;
        int width = 0, height = 0;            // size of the picture that was cast
        int across = 0, down = 0;             // number of plans in each direction
        int shownWidth = 0, shownHeight = 0;  // size of the new picture
    };
    void sizeImage(Eye& eye, int width, int height);

    ShaderProgram mProgram;
    GlVertexArray mVertices;
    std::array<Eye, 2> mEyes;
    std::vector<LatePlan> mPlans;
    std::vector<float> mTexels;  // the plans as uploaded: three numbers of each LatePlan
    bool mWorks = true;
};

}  // namespace stereonav
