// What of the interface stays beside the pictures while they change: columns of panels are drawn once, kept,
// and copied into each eye's part for every picture after that. Where the processor draws (llvmpipe) a copy
// costs some 3 % of drawing the panels again; a graphics card is spared the triangles.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/display/gl_object.h"

namespace stereonav {

// Where the picture lies in each eye's part, pixels from the part's top left corner: the interface beside it
// is opaque.
struct InterfaceOpening {
    glm::ivec2 corner{0}, size{0};
    bool operator==(const InterfaceOpening&) const = default;
};

// An eye's part in pixels of the framebuffer, y downwards from its top.
struct InterfacePart {
    glm::ivec2 corner{0}, size{0};
};

// Keeps the interface beside the pictures. In one context, whose framebuffer is that of the window.
class InterfaceStill {
public:
    // Returns whether the part beside the opening is kept, as it was drawn with this digest.
    bool holds(std::uint64_t digest, const InterfaceOpening& opening, const InterfacePart& part) const;
    // Keeps it from a part that is drawn. whole: pixels of the framebuffer.
    void keep(std::uint64_t digest, const InterfaceOpening& opening, const InterfacePart& part,
              const glm::ivec2& whole);
    void put(const InterfacePart& part) const;  // part: of the same size, in the framebuffer
    void forget() { mDigest.reset(); }

private:
    void copy(bool back, const InterfacePart& part) const;

    struct Store {
        GlTexture texture;
        GlFramebuffer framebuffer;
    };
    std::optional<Store> mStore;
    glm::ivec2 mStored{0}, mWhole{0}, mSize{0};  // pixels: of the store, the framebuffer, the part
    InterfaceOpening mOpening;
    std::optional<std::uint64_t> mDigest;
};

}  // namespace stereonav
