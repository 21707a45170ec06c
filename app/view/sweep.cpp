// Choice between the two sweeps, textures of each medium that is shown, and the fallback to the CPU.
#include "app/view/sweep.h"

#include <epoxy/gl.h>

#include <map>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/display/hidden_context.h"
#include "engine/display/medium_gpu.h"
#include "engine/scene/scene.h"

namespace stereonav {
namespace {

class GpuSweep {
public:
    GpuSweep(HiddenContext* context, SweepChoice choice, std::function<void(const std::string&)> tell)
        : mContext(context), mTell(std::move(tell)), mDecided(choice != SweepChoice::Auto) {}
    ~GpuSweep() { end(); }
    GpuSweep(const GpuSweep&) = delete;
    GpuSweep& operator=(const GpuSweep&) = delete;

    bool sweep(const SweepTask& task, const std::function<void()>& cpu) {
        if (!std::exchange(mDecided, true) && !isFaster(task, cpu)) end();
        if (mUsable && tried(task)) return true;
        cpu();
        return false;
    }

private:
    // Compares the second frame, since the first one also compiles shaders, uploads and allocates.
    bool isFaster(const SweepTask& task, const std::function<void()>& cpu) {
        if (!tried(task)) return false;
        Stopwatch watch;
        if (!tried(task)) return false;
        const double gpu_ms = watch.lap_ms();
        cpu();
        if (watch.lap_ms() < gpu_ms) return false;
        cpu();
        return gpu_ms < watch.lap_ms();
    }

    bool tried(const SweepTask& task) {
        try {
            const HiddenContext::Use use(mContext);
            std::unique_ptr<MediumGpu>& gpu = mGpus[&task.medium];
            if (!gpu) gpu = std::make_unique<MediumGpu>(task.medium);
            gpu->render(task.look, task.setting, task.eyes, task.head, task.time, task.pictures);
            return true;
        } catch (const Error& error) {
            end();
            mTell(error.what());
            return false;
        }
    }

    // Objects are deleted in their own context or, where that is not available, with it.
    void end() {
        mUsable = false;
        if (mGpus.empty()) return;
        try {
            const HiddenContext::Use use(mContext);
            mGpus.clear();
        } catch (const Error&) {
            for (auto& [medium, gpu] : mGpus) static_cast<void>(gpu.release());
        }
    }

    HiddenContext* mContext;
    std::function<void(const std::string&)> mTell;
    bool mDecided, mUsable = true;
    std::map<const Medium*, std::unique_ptr<MediumGpu>> mGpus;  // for the models that are shown
};

}  // namespace

SweepChooser gpuSweep(HiddenContext* context, SweepChoice choice,
                      std::function<void(const std::string&)> tell) {
    auto gpu = std::make_shared<GpuSweep>(context, choice, std::move(tell));
    return [gpu = std::move(gpu)](const SweepTask& task, const std::function<void()>& cpu) {
        return gpu->sweep(task, cpu);
    };
}

ViewSweep::ViewSweep(SweepChoice choice) : mChoice(choice) {
    if (choice == SweepChoice::Cpu) return;
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    if (choice == SweepChoice::Auto && (!renderer || drawsInSoftware(renderer))) return;
    try {
        mContext = std::make_shared<HiddenContext>();
    } catch (const Error& error) {
        tell(error.what());
    }
}

ViewSweep::~ViewSweep() = default;

void ViewSweep::tell(const std::string& notice) {
    if (mChoice != SweepChoice::Gpu) return;  // nobody has asked for the graphics card
    const std::lock_guard lock(mMutex);
    mNotice = "swept on the CPU: " + notice;
}

std::string ViewSweep::takeNotice() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mNotice, "");
}

void ViewSweep::use(const Scene& scene) {
    auto* const frames = scene.offered<SweptFrames>();
    if (mContext && frames)
        frames->setSweep(
            gpuSweep(mContext.get(), mChoice, [this](const std::string& notice) { tell(notice); }));
}

}  // namespace stereonav
