// Puts two eyes on the screen in any output mode: uploads them and composes in one fragment shader,
// with the tables of engine/image/stereo_compose, whose picture it equals within 1/255.
#pragma once

#include <array>
#include <map>
#include <utility>

#include "engine/display/gl_object.h"
#include "engine/display/shader_program.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

// Framebuffer pixels, y from the bottom.
struct Viewport {
    int x = 0, y = 0, width = 0, height = 0;
};

// What is left free of a part, pixels at its borders.
struct PartInset {
    int left = 0, top = 0, right = 0, bottom = 0;
};

// Needs a current OpenGL 3.3 core context, the same for all calls; one thread.
class StereoPresenter {
public:
    // right may be empty: the left eye then stands for both. Throws Error where the sizes differ or
    // exceed the driver's textures.
    void upload(const Plane<PackedColor>& left, const Plane<PackedColor>& right);
    bool hasPicture() const { return mWidth > 0; }
    // Over each eye from now on (engine/display/eye_overlay.h), of its picture's size; 0: nothing.
    void setLayers(GLuint left, GLuint right) { mLayers = {left, right}; }

    // Fills the viewport with the composed picture (nearest pixels where the sizes differ).
    // turnX, turnY: where the viewport's top left pixel lies on the screen, so that interleaved
    // displays get each eye on its own rows and columns wherever the window is.
    // inset: of the picture within each eye's part of the viewport.
    void draw(const ComposeSetting& setting, const Viewport& viewport, int turnX = 0, int turnY = 0,
              const PartInset& inset = {}) const;

private:
    // What one program draws; see shaders/stereo_present.frag.
    enum class Pass { OneEye, HalfWidth, HalfHeight, Rows, Columns, Checkerboard, Anaglyph };

    void uploadEye(const GlTexture& texture, const Plane<PackedColor>& eye) const;
    const ShaderProgram& programFor(Pass pass, bool layered) const;
    static Pass passOf(const OutputModeInfo& info);
    // pictureWidth, pictureHeight: what is scaled to the viewport; first, second: eyes, 0 or 1.
    void drawPass(Pass pass, int first, int second, const Viewport& viewport, int pictureWidth,
                  int pictureHeight, const ComposeSetting& setting, int turnX, int turnY) const;

    // With layers and without; made when first drawn.
    mutable std::map<std::pair<Pass, bool>, ShaderProgram> mPrograms;
    GlVertexArray mVertices;
    GlTexture mEyes[2];  // left, right
    std::array<GLuint, 2> mLayers{};
    bool mOneEye = false;
    int mWidth = 0, mHeight = 0;
    int mTextureWidth[2] = {0, 0}, mTextureHeight[2] = {0, 0};
};

}  // namespace stereonav
