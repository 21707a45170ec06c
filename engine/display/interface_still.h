// The part of the interface that stays the same while pictures change: columns of panels are drawn once,
// stored, and copied into each eye's part for every later picture. Where the processor draws (llvmpipe) a
// copy costs about 3 % of drawing the panels again; a graphics card is spared the triangles.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/display/gl_object.h"

namespace stereonav {

// The picture's place in each eye's part, in pixels from the part's top left corner. Outside it the interface
// is opaque.
struct InterfaceOpening {
    glm::ivec2 corner{0}, size{0};
    bool operator==(const InterfaceOpening&) const = default;
};

// An eye's part in pixels of the framebuffer, y downwards from its top.
struct InterfacePart {
    glm::ivec2 corner{0}, size{0};
};

// Stores the interface beside the pictures. For one context, whose framebuffer is the window's.
class InterfaceStill {
public:
    // Returns whether the interface beside the opening is stored as drawn with this digest.
    bool holds(std::uint64_t digest, const InterfaceOpening& opening, const InterfacePart& part) const;
    // Stores it from a part that has been drawn. whole: pixels of the framebuffer.
    void keep(std::uint64_t digest, const InterfaceOpening& opening, const InterfacePart& part,
              const glm::ivec2& whole);
    void put(const InterfacePart& part) const;  // part: place in the framebuffer, of the stored size
    void forget() { mDigest.reset(); }

private:
    void copy(bool back, const InterfacePart& part) const;

    struct Store {
        GlTexture texture;
        GlFramebuffer framebuffer;
    };
    std::optional<Store> mStore;
    glm::ivec2 mStored{0}, mWhole{0}, mSize{0};  // pixels: of the stored texture, the framebuffer, the part
    InterfaceOpening mOpening;
    std::optional<std::uint64_t> mDigest;
};

}  // namespace stereonav
