// More rays where one does not stand for its pixel: along silhouettes, where what lies on both sides of an
// edge shows in one pixel. A picture of one ray a pixel tells where that is; only there rays are added. Each
// eye's edges are found and cast in its own picture, after the right one was warped: a pixel of which a part
// is near and a part is far is never warped as one surface, so no halo moves with it.
#pragma once

#include <memory>

#include "engine/image/eye_image.h"
#include "engine/image/plane.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

// Where rays are added: what EdgeRow says of each member.
struct EdgeSetting {
    int rays = 0;  // added to the one in the centre, 0 (none) to kMostEdgeRays
    // Differences of a packed channel, 1 to 1023. Pixels with less are seldom wrong enough to be worth rays:
    // half of it adds 1 dB on ground, for half of the time again (docs/measured.md).
    int contrast = 90;
    int strongContrast = 256;
    double depthBreak = 0.003;  // share of 1 / depth by which it is bent
    // A bend by so much means that one thing stands before another: there a faint edge, too, is a line of
    // steps.
    int jumpContrast = 25;
    double depthJump = 0.3;  // share of 1 / depth
};
constexpr int kMostEdgeRays = 64, kDefaultEdgeRays = 4;

struct EdgeTimings {
    double ms = 0;         // milliseconds
    long long pixels = 0;  // to which rays were added
};

// Keeps its buffers between pictures. Not for two threads at once; the work inside runs on all threads.
class EdgeRays {
public:
    EdgeRays();
    ~EdgeRays();
    EdgeRays(EdgeRays&&) noexcept;
    EdgeRays& operator=(EdgeRays&&) noexcept;

    // Adds rays to a picture of `view`, cast or warped, one ray a pixel. The colours of its edges become the
    // mean, in linear light, of the pixel's own and of the added rays'; every other plane stays that of the
    // ray in the centre. Throws Error.
    EdgeTimings smooth(const EyeRenderer& renderer, const EyeView& view, const EdgeSetting& setting,
                       EyeImage& image);

    // 255 at the edges of the last picture. Empty before the first.
    const Plane<std::uint8_t>& edges() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

// Finds the edges of a picture: sizes the mask, 255 there and 0 elsewhere. Runs on all threads.
void findEdges(const EyeImage& image, const EdgeSetting& setting, Plane<std::uint8_t>& edges);

}  // namespace stereonav
