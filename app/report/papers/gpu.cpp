#include "app/report/papers/gpu.h"

#include <vector>

#include "engine/base/stopwatch.h"
#include "engine/display/medium_gpu.h"
#include "engine/display/offscreen_context.h"

namespace stereonav {

struct PaperGpu::State {
    OffscreenContext context;
    std::unique_ptr<MediumGpu> sweep;  // needs the context
    const Medium* medium = nullptr;
    std::vector<MediumPicture> pictures;
};

PaperGpu::PaperGpu() : mState(std::make_unique<State>()) {}
PaperGpu::~PaperGpu() = default;

std::string PaperGpu::problem() const {
    return mState->context.current() && epoxy_gl_version() >= 45 ? "" : "no OpenGL 4.5 here";
}

std::string PaperGpu::renderer() const {
    return problem().empty() ? reinterpret_cast<const char*>(glGetString(GL_RENDERER)) : "none";
}

Spread PaperGpu::time(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
                      std::span<const EyeView> eyes, int frames) {
    if (mState->medium != &medium) forget();
    if (!mState->sweep) mState->sweep = std::make_unique<MediumGpu>(medium);
    mState->medium = &medium;
    mState->pictures.resize(eyes.size());
    std::vector<double> ms;
    for (int frame = 0; frame <= frames; ++frame) {
        const Stopwatch watch;
        mState->sweep->render(look, setting, eyes, eyes[0].head, 0, mState->pictures);
        if (frame > 0) ms.push_back(watch.elapsed_ms());  // the first picture compiles and uploads
    }
    return spreadOf(ms);
}

void PaperGpu::forget() {
    mState->sweep.reset();
    mState->medium = nullptr;
}

}  // namespace stereonav
