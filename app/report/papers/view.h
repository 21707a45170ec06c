// One picture of the engine of Wyman et al. 2006: what it shows, what it looks up, and what a frame costs.
#pragma once

#include <memory>
#include <vector>

#include "app/report/papers/data.h"
#include "app/report/run.h"
#include "engine/light/bake/bake_rate.h"

namespace stereonav {

constexpr int kPaperOrder = 5;  // of the harmonics, as there

// The whole subject from outside, its surface where nothing is said.
class EngineView {
public:
    explicit EngineView(const PaperEngine& engine);

    // Of a picture of `side` pixels square: the texels that it looks up, and the points that its pixels show,
    // both in small pieces in a random order.
    struct Seen {
        std::vector<TexelPiece> texels;
        std::vector<PointPiece> pixels;
        std::size_t texelCount = 0, pixelCount = 0;
    };
    Seen seen(int side) const;

    // Frames of `side` pixels square by what they are lit with; in turn, so that the machine's moods meet all
    // alike. Harmonics: dotted anew each frame, of what is in view.
    struct FrameTimes {
        Spread diffuse, shadowed, phongShadowed, irradiance, harmonics;
    };
    FrameTimes frameTimes(ReportRun& run, int side, int frames);

    // Of light kept for the texels around the surface shown.
    struct Memory {
        std::size_t texels = 0, irradianceBytes = 0, harmonicsBytes = 0;
    };
    Memory memory() const;

private:
    ColonScene mScene;
};

}  // namespace stereonav
