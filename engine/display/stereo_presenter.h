// Puts two eyes on the screen in any output mode: uploads them and composes in one fragment shader,
// with the tables of engine/image/stereo_compose, whose picture it equals within 1/255. Eyes that are shown
// whole and in their own size are copied (plain_eyes.h) and equal it.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/display/plain_eyes.h"
#include "engine/display/shader_program.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

// A part of the framebuffer in pixels, y from the bottom.
struct Viewport {
    int x = 0, y = 0, width = 0, height = 0;
};

// A texture over an eye: sRGB values multiplied by their alpha, row 0 at the bottom, and the box that is not
// empty.
struct EyeLayer {
    struct Box {  // pixels from the top left corner, the last ones beside it
        glm::ivec2 first{0}, last{0};
    };
    GLuint texture = 0;
    std::vector<Box> boxes;
};

// Pixels at a part's borders that stay free.
struct PartInset {
    int left = 0, top = 0, right = 0, bottom = 0;
};

// Needs a current OpenGL 3.3 core context, the same for all calls; one thread.
class StereoPresenter {
public:
    using SharedEye = std::shared_ptr<const Plane<PackedColor>>;
    // Shows these eyes. right: null or empty shows the left eye for both. Pictures are kept until the next
    // call, and are uploaded when they are drawn, in the form that drawing needs. Throws Error where the
    // sizes differ or exceed the driver's textures.
    void show(SharedEye left, SharedEye right);
    // Shows eyes that are on the graphics card already (engine/display/late_warp_gpu.h): textures of this
    // size, row 0 on top, which must not change until they were drawn. right 0: the left eye for both.
    void showTextures(GLuint left, GLuint right, int width, int height);
    // Shows copies of these eyes. Throws Error as show() does.
    void upload(const Plane<PackedColor>& left, const Plane<PackedColor>& right);
    bool hasPicture() const { return mWidth > 0; }
    // Sets the layers over each eye from now on (engine/display/eye_overlay.h), of the picture's size; empty:
    // no layers.
    void setLayers(std::optional<std::array<EyeLayer, 2>> layers) { mLayers = std::move(layers); }

    // Fills the viewport with the composed picture (nearest pixels where the sizes differ).
    // turnX, turnY: where the viewport's top left pixel lies on the screen, so that interleaved
    // displays get each eye on its own rows and columns wherever the window is.
    // inset: of the picture within each eye's part of the viewport.
    void draw(const ComposeSetting& setting, const Viewport& viewport, int turnX = 0, int turnY = 0,
              const PartInset& inset = {}) const;

private:
    // Kinds of drawing, one for each shader program; see shaders/stereo_present.frag.
    enum class Pass { OneEye, HalfWidth, HalfHeight, Rows, Columns, Checkerboard, Anaglyph };

    void checkSizes(const Plane<PackedColor>& left, const Plane<PackedColor>* right) const;
    void uploadEye(std::size_t eye) const;
    // Copies an eye to a viewport of its size, with its layer over it. Returns false where the driver can not
    // do that.
    bool copyEye(std::size_t eye, const Viewport& viewport) const;
    const ShaderProgram& programFor(Pass pass, bool layered) const;
    static Pass passOf(const OutputModeInfo& info);
    // pictureWidth, pictureHeight: what is scaled to the viewport; first, second: eyes, 0 or 1.
    void drawPass(Pass pass, int first, int second, const Viewport& viewport, int pictureWidth,
                  int pictureHeight, const ComposeSetting& setting, int turnX, int turnY) const;

    // Programs with layers and without; made when first drawn.
    mutable std::map<std::pair<Pass, bool>, ShaderProgram> mPrograms;
    GlVertexArray mVertices;
    // An eye, left or right: its picture, and what of it is uploaded.
    struct Eye {
        SharedEye picture;
        GlTexture texture;
        int width = 0, height = 0;  // size of the texture
        bool uploaded = false, plain = false;
        GLuint given = 0;  // texture given by showTextures(), used instead
        GLuint name() const { return given != 0 ? given : texture.name(); }
    };
    mutable std::array<Eye, 2> mEyes;
    mutable PlainEyes mPlain;
    mutable std::unique_ptr<ShaderProgram> mLayerProgram;
    std::optional<std::array<EyeLayer, 2>> mLayers;
    bool mOneEye = false;
    int mWidth = 0, mHeight = 0;
};

}  // namespace stereonav
