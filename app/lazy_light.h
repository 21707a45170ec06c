// Light of a volume that is worked out while one looks at it: the background bake of a scene that a window
// shows, with all that it refers to.
#pragma once

#include <cstdint>
#include <memory>

#include "app/commands.h"
#include "colon/colon_scene.h"
#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/light/lazy_bake.h"
#include "engine/light/texel_light.h"

namespace stereonav {

// Throws Error where --light asks for it, for commands that draw many frames, each of which would be lit in
// part.
void refuseLazyLight(const SceneOptions& options);

class LazyLight {
public:
    // scene must outlive this; its look is set to show the light. Lit by --sky, or by what bake takes where
    // nothing is said. Throws Error, Cancelled.
    LazyLight(const SceneOptions& options, ColonScene& scene, Progress& progress);

    // What a frame saw is lit next. Any thread; returns at once.
    void seen(const EyeView& view, const EyeImage& image);
    // Grows as texels change.
    std::uint64_t changes() const { return mBake->changes(); }
    // Until all that was seen last is lit.
    void waitUntilDone() const;

private:
    std::shared_ptr<IlluminationVolume> mLight;
    std::unique_ptr<TexelLighter> mLighter;
    std::unique_ptr<LazyBake> mBake;  // last: it stops first
};

}  // namespace stereonav
