// The interface over the picture: panels, menus and lines of text, with Dear ImGui, which receives the
// window's events. It is laid out once, in units of its own, and drawn into each eye's part of the window at
// zero parallax, so that it can be read in stereo; the pointer works the same in each part.
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

// Where the interface is drawn, and the size for which it is laid out.
struct InterfacePlaces {
    std::vector<InterfaceArea> areas{{}};  // at least one
    // Size as shares of the window's size along each axis; an eye squeezed to half counts with its unsqueezed
    // size, 1.
    glm::vec2 size{1};
    bool operator==(const InterfacePlaces&) const = default;
};

// Needs the window's context to be current in every call. Several may exist, one for each window.
class Interface final : public InputSink {
public:
    explicit Interface(Window& window);  // becomes the window's input sink; the window must outlive it
    ~Interface() override;
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    // Sets the look for the next layout. A new scale needs a new font: about 0.1 s.
    void setLook(const InterfaceLook& look);
    const InterfaceLook& look() const;

    // Lays out the elements that `draw` makes by calls of Dear ImGui. It is called once or several times,
    // since a box knows its size only in the next turn, and simultaneous events are handled one after
    // another. dt: seconds since the last call. Returns false where nothing looks different.
    bool layOut(const InterfacePlaces& places, double dt, const std::function<void()>& draw);
    // Draws over the framebuffer's content. opening: the picture's place in each part, which is left out;
    // empty: draws everywhere.
    void render(const std::optional<InterfaceOpening>& opening = std::nullopt);
    // Returns whether a layout now could look different because of user input, or of another window or look.
    // Changes that the program itself makes are known to the caller.
    bool waits(const InterfacePlaces& places) const;

    glm::vec2 size() const;  // units of the layout
    // Makes this the target of the following calls of Dear ImGui.
    void use() const;
    glm::vec2 textSize(const std::string& text) const;  // units
    // Returns whether the pointer is over the picture, and its place in shares of the interface's size; false
    // while it is over the interface, or outside.
    bool pointerOverPicture(glm::dvec2& place) const;
    // drawn: the pointer over the picture is drawn by other code (eye_overlay.h).
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

// Notes that the content of a texture used in Dear ImGui calls has changed, so that interfaces are drawn
// again.
void noteChangedTexture();

}  // namespace stereonav
