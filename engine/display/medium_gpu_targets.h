// Targets of a sweep on the GPU: a region for each eye and two for the light, which are read and written in
// turn. All regions lie in one target and are selected by viewports, so that targets need not be switched
// between passes (Kniss et al. 2003, section 4; row K8 of docs/ledger.md); or each has a target of its own.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/display/gl_object.h"
#include "engine/medium/model/medium_picture.h"

namespace stereonav {

struct TargetSizes {
    std::vector<glm::ivec2> eyes;  // pixels
    glm::ivec2 light{0};           // texels, 0: none
    bool single = true;            // one target for all
    bool operator==(const TargetSizes&) const = default;
};

class MediumTargets {
public:
    // Width of the ring of texels around the light's regions, which keep the initial light.
    static constexpr int kRing = 1;

    // Throws Error where a target would be larger than the driver allows.
    explicit MediumTargets(const TargetSizes& sizes);

    // Clears: eyes see all of the background and no light, the light's buffers are 1; leaves no scissor.
    void clear();
    // Sets the initial scattered light, in both buffers with the ring: texels row by row.
    void startLight(const std::vector<float>& scattered);

    // Selects the target for the following draws; sets framebuffer and viewport.
    void drawToEye(int eye) { drawTo(mEyes[static_cast<std::size_t>(eye)]); }
    void drawToLight(int turn) { drawTo(mLights[turn & 1]); }
    // Returns the corner of a region in its texture; for the light's, inside the ring.
    glm::ivec2 eyeAt(int eye) const { return mEyes[static_cast<std::size_t>(eye)].at; }
    glm::ivec2 lightAt(int turn) const { return mLights[turn & 1].at; }
    GLuint eyeTexture(int eye) const { return surfaceOf(mEyes[static_cast<std::size_t>(eye)]).color.name(); }
    GLuint lightTexture(int turn) const { return surfaceOf(mLights[turn & 1]).color.name(); }

    const TargetSizes& sizes() const { return mSizes; }
    void read(int eye, MediumPicture& picture) const;  // waits until the GPU is done

private:
    struct Surface {
        glm::ivec2 size{0};
        bool forEyes = false;
        GlTexture color;      // RGBA32F
        GlTexture viewDepth;  // R32F: eyes only
        GlTexture ended;      // depth buffer: eyes only
        GlFramebuffer framebuffer;
    };
    struct Region {
        std::size_t surface = 0;
        glm::ivec2 at{0}, size{0};
    };

    const Surface& surfaceOf(const Region& region) const { return mSurfaces[region.surface]; }
    void layOutOne();
    void layOutEach();
    void makeSurface(Surface& surface);
    void drawTo(const Region& region);

    TargetSizes mSizes;
    std::vector<Surface> mSurfaces;
    std::vector<Region> mEyes;
    Region mLights[2];
};

}  // namespace stereonav
