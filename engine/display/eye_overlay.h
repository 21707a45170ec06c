// Marks over the picture at a depth of their own: the pointer, and names of places. Each eye has a layer of
// its picture's size, which StereoPresenter draws over that eye before it composes, so that every layout
// shows it to the right eye.
#pragma once

#include <array>
#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/display/interface_theme.h"
#include "engine/display/stereo_presenter.h"

namespace stereonav {

class Interface;

// A mark in both eyes. Places are pixels of each eye's picture, (0, 0) its top left corner.
struct OverlayMark {
    glm::vec2 left{0}, right{0};
    std::string text;      // text beside a point; "": the pointer
    glm::vec2 textAt{0};   // top left corner of the text, relative to the place
    bool dot = false;      // a small point, without a text
    glm::u8vec3 ink{255};  // sRGB, for points and texts
    bool operator==(const OverlayMark&) const = default;
};

// Layers that marks are drawn into. In the window's context.
class EyeOverlay {
public:
    // Draws the marks with the interface's letters, unless they are there already. size: pixels of each eye's
    // picture. Returns whether the layers changed.
    bool draw(const Interface& interface, const glm::ivec2& size, const std::vector<OverlayMark>& marks);
    // Layers of the left and of the right eye; none while nothing is there.
    std::optional<std::array<EyeLayer, 2>> layers() const;

private:
    void drawEye(std::size_t eye, const InterfaceLook& look);

    struct Layers {
        std::array<GlTexture, 2> textures;
        GlFramebuffer target;
    };
    std::optional<Layers> mLayers;  // once there is something
    std::array<std::vector<EyeLayer::Box>, 2> mBoxes;
    std::vector<OverlayMark> mMarks;
    glm::ivec2 mSize{0};
    InterfaceLook mLook;
};

}  // namespace stereonav
