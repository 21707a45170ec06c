// Where the viewer sweeps media: on the processor or, by --sweep, on the graphics card in a context of its
// own. Made on the main thread beside the window; scenes use it on the thread that makes frames.
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

// Sweeps one scene's media in `context`, or in what is current where that is null, and goes on with the
// processor for good where it can not, telling why.
SweepChooser gpuSweep(HiddenContext* context, SweepChoice choice,
                      std::function<void(const std::string&)> tell);

class ViewSweep {
public:
    // On the main thread with the window's context current. Holds nothing where the processor is chosen.
    explicit ViewSweep(SweepChoice choice);
    ~ViewSweep();  // after all scenes that use it

    // SweptFrames that the scene offers are swept here from now on. Any thread.
    void use(const Scene& scene);
    // Why the graphics card does not sweep although it was asked to, "" otherwise; told once. Any thread.
    std::string takeNotice();

private:
    void tell(const std::string& notice);

    SweepChoice mChoice;
    std::shared_ptr<HiddenContext> mContext;  // null: the processor
    std::mutex mMutex;                        // guards the notice
    std::string mNotice;
};

}  // namespace stereonav
