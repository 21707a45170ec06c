// What lies over the picture: panels, menus and lines of text, through Dear ImGui, fed with the window's
// events. It is laid out once, in units of its own, and drawn into each eye's part of the window at zero
// parallax, so that it can be read in stereo; under the pointer each part is the same interface.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/display/interface_still.h"
#include "engine/display/interface_theme.h"
#include "engine/display/window.h"

namespace stereonav {

// A part of the window that shows all of the interface, as shares of the window's size, (0, 0) top left.
struct InterfaceArea {
    float x = 0, y = 0, width = 1, height = 1;
    bool operator==(const InterfaceArea&) const = default;
};

// Where it is drawn, and how large it takes itself to be.
struct InterfacePlaces {
    std::vector<InterfaceArea> areas{{}};  // at least one
    // Shares of the window's size, along each axis: what an eye that is squeezed to half stands for is 1.
    glm::vec2 size{1};
    bool operator==(const InterfacePlaces&) const = default;
};

// Needs the window's context to be current in every call. Several may be there, each of its own window.
class Interface final : public InputSink {
public:
    explicit Interface(Window& window);  // the window's sink from now on; the window outlives it
    ~Interface() override;
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    // Sets the look of the next layout. A font is made anew where the scale changes: some 0.1 s.
    void setLook(const InterfaceLook& look);
    const InterfaceLook& look() const;

    // Lays out what `draw` says by calls of Dear ImGui, once or several times: a box knows its size one turn
    // late, and events that came together are felt one after another. dt: seconds since the last. False: all
    // looks as before.
    bool layOut(const InterfacePlaces& places, double dt, const std::function<void()>& draw);
    // Draws over what is in the framebuffer. opening: where the picture lies in each part; none: everywhere.
    void render(const std::optional<InterfaceOpening>& opening = std::nullopt);
    // Returns whether a layout now could show something else for what the user did, or for another window or
    // look. What is shown of the program's own doing, the caller knows.
    bool waits(const InterfacePlaces& places) const;

    glm::vec2 size() const;                             // units of the layout
    void use() const;                                   // Dear ImGui's calls that follow are of this one
    glm::vec2 textSize(const std::string& text) const;  // units
    // Returns whether the pointer is over the picture, and where, in shares of the interface's size; false
    // while it is over the interface, or outside.
    bool pointerOverPicture(glm::dvec2& place) const;
    // Leaves the pointer over the picture to whoever draws that (eye_overlay.h), where `drawn`.
    void setPointerOfPicture(bool drawn);
    // Returns whether the user is editing some text.
    bool active() const;

    void pointerAt(const glm::dvec2& place) override;
    void pointerLeft() override;
    bool takesButton(int button, bool pressed) override;
    bool takesWheel(double notches) override;
    bool takesKey(int key, int modifiers, bool pressed) override;
    bool takesText(unsigned codePoint) override;
    bool holdsKeyboard() const override;

private:
    struct State;
    std::unique_ptr<State> mState;
};

// Notes that a texture which is drawn by calls of Dear ImGui has other contents: interfaces are drawn again.
void noteChangedTexture();

}  // namespace stereonav
