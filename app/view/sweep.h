// The processor that sweeps media in the viewer: the CPU or, by --sweep, the graphics card in a context of
// its own. Made on the main thread beside the window; scenes use it on the thread that makes frames.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "app/options/option_types.h"
#include "engine/display/renderer_name.h"
#include "engine/medium/sweep/swept_frames.h"

namespace stereonav {

class HiddenContext;
class Scene;

// Sweeps one scene's media in `context`, or in the current one where it is null, and goes on with the CPU for
// good where that is not possible, with the reason.
SweepChooser gpuSweep(HiddenContext* context, SweepChoice choice,
                      std::function<void(const std::string&)> tell);

class ViewSweep {
public:
    // To be called on the main thread with the window's context current. Holds nothing where the CPU is
    // chosen.
    explicit ViewSweep(SweepChoice choice);
    ~ViewSweep();  // after all scenes that use it

    // Sweeps the SweptFrames that the scene offers from now on. Any thread.
    void use(const Scene& scene);
    // Returns once why the graphics card does not sweep although it was asked to, "" otherwise. Any thread.
    std::string takeNotice();

private:
    void tell(const std::string& notice);

    SweepChoice mChoice;
    std::shared_ptr<HiddenContext> mContext;  // null: the CPU
    std::mutex mMutex;                        // guards the notice
    std::string mNotice;
};

}  // namespace stereonav
