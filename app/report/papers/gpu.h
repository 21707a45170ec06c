// The sweep in GLSL, timed off-screen, into one target split by viewports or into several (row K8 of
// docs/ledger.md).
#pragma once

#include <memory>
#include <span>
#include <string>

#include "engine/metrics/spread.h"

namespace stereonav {

class Medium;
struct EyeView;
struct MediumLook;
struct SweepSetting;

class PaperGpu {
public:
    PaperGpu();  // no error where there is no OpenGL 4.5 or the program is built without it
    ~PaperGpu();

    // "": it can be used.
    std::string problem() const;
    // As the driver calls itself: llvmpipe is the software rasteriser.
    std::string renderer() const;
    // Milliseconds of a picture by the clock, after one that is not counted. medium must outlive this, or be
    // forgotten first. Throws Error where the medium does not fit.
    Spread time(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
                std::span<const EyeView> eyes, int frames);
    void forget();

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
