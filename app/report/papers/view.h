// One picture of the engine of Wyman et al. 2006: what it shows, the texels that it looks up, and its cost.
#pragma once

#include <memory>
#include <vector>

#include "app/report/papers/data.h"
#include "app/report/run.h"
#include "engine/light/bake/bake_rate.h"

namespace stereonav {

constexpr int kPaperOrder = 5;  // order of the harmonics, as in the paper

// The whole subject from outside; its surface unless something else is said.
class EngineView {
public:
    explicit EngineView(const PaperEngine& engine);

    // Parts of a picture of `side` x `side` pixels: the texels that it looks up, and the points that its
    // pixels show, both in small pieces in random order.
    struct Seen {
        std::vector<TexelPiece> texels;
        std::vector<PointPiece> pixels;
        std::size_t texelCount = 0, pixelCount = 0;
    };
    Seen seen(int side) const;

    // Times of frames of `side` x `side` pixels by their light, measured in turn, so that changes in the
    // machine's speed affect all equally. Harmonics: multiplied anew in each frame, for the texels in view.
    struct FrameTimes {
        Spread diffuse, shadowed, phongShadowed, irradiance, harmonics;
    };
    FrameTimes frameTimes(ReportRun& run, int side, int frames);

    // Memory of light for the texels around the surface.
    struct Memory {
        std::size_t texels = 0, irradianceBytes = 0, harmonicsBytes = 0;
    };
    Memory memory() const;

private:
    ColonScene mScene;
};

}  // namespace stereonav
