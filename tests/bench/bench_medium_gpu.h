// Times the sweep in GLSL off-screen, for benches that compare it with the CPU's. By the clock, not by GPU
// timers: Mesa's software rasteriser answers those at once. MediumGpu::render waits for its pictures.
#pragma once

#include <algorithm>
#include <ctime>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/stopwatch.h"
#include "engine/display/medium_gpu.h"
#include "tests/display/egl_context.h"

namespace stereonav {

struct GpuSweepTime {
    double median_ms = 0, least_ms = 0;  // by the clock
    double processor_ms = 0;             // time of all threads of this process, the least of a frame
};

// Only one at a time; what it makes lives in its context, which stays current.
class GpuSweepTimer {
public:
    bool available() const { return mContext.current() && epoxy_gl_version() >= 45; }
    // Returns the driver's name of the renderer: llvmpipe is the software rasteriser.
    std::string renderer() const {
        return available() ? reinterpret_cast<const char*>(glGetString(GL_RENDERER)) : "none";
    }

    // One frame first that is not counted: shaders are compiled and textures uploaded. The last frame's
    // pictures stay in pictures(). head: the mean of the eyes'.
    GpuSweepTime time(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
                      std::span<const EyeView> eyes, int frames = 3, double atTime = 0) {
        if (mMedium != &medium) mGpu.reset();
        if (!mGpu) mGpu = std::make_unique<MediumGpu>(medium);
        mMedium = &medium;
        mPictures.resize(eyes.size());
        const auto render = [&] { mGpu->render(look, setting, eyes, eyes[0].head, atTime, mPictures); };
        render();
        std::vector<double> clock, processor;
        for (int frame = 0; frame < std::max(frames, 1); ++frame) {
            const Stopwatch watch;
            const std::clock_t before = std::clock();
            render();
            clock.push_back(watch.elapsed_ms());
            processor.push_back(1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
        }
        std::sort(clock.begin(), clock.end());
        return {clock[clock.size() / 2], clock[0], *std::min_element(processor.begin(), processor.end())};
    }
    const std::vector<MediumPicture>& pictures() const { return mPictures; }
    // To be called before a medium that was timed is destroyed.
    void forget() {
        mGpu.reset();
        mMedium = nullptr;
    }

private:
    EglContext mContext;
    std::unique_ptr<MediumGpu> mGpu;  // in the context
    const Medium* mMedium = nullptr;
    std::vector<MediumPicture> mPictures;
};

}  // namespace stereonav
