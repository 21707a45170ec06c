// Times of the sweep in GLSL, off-screen, into one target divided by viewports or into several (row K8 of
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
    PaperGpu();  // throws nothing where OpenGL 4.5 is missing or the program is built without it
    ~PaperGpu();

    // Returns why it can not be used; "" where it can.
    std::string problem() const;
    // Returns the driver's name of the renderer: llvmpipe is the software rasteriser.
    std::string renderer() const;
    // Returns the milliseconds of a picture in real time, after one that is not counted. medium must outlive
    // this object, or be forgotten first. Throws Error where the medium does not fit.
    Spread time(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
                std::span<const EyeView> eyes, int frames);
    void forget();

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
