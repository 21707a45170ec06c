// Light of a volume that is worked out while one looks at it: the background bake of a scene that a window
// shows, with all that it refers to.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/light/bake/lazy_bake.h"
#include "engine/light/paths/texel_light.h"
#include "engine/light/transfer/turning_sky.h"

namespace stereonav {

class LazyLight {
public:
    // scene's look is set to show the light. Irradiance is lit by --sky, or by what bake
    // takes where nothing is said; transfer as baked one is. Throws Error, Cancelled.
    LazyLight(const SceneOptions& options, ColonScene& scene, Progress& progress);

    // Another surface of the same volume is shown, at an isovalue in stored numbers: what is lit stays so,
    // and what it lacks is lit next. Any thread.
    void showSurface(float isovalue);

    // Of transfer: where the sky stands; before a frame, that it stands elsewhere.
    bool turns() const { return !mStraight.empty(); }
    const SkyTurn& turn() const { return mTurn; }
    void turnTo(const SkyTurn& turn);

    // What a frame saw is lit next; all of it when the frame comes again. Returns at once.
    void seen(const EyeView& view, const EyeImage& image);
    // Grows as texels change, and while the last frame is to come again.
    std::uint64_t changes() const { return mBake->changes() + mLooks; }
    // Until all that was seen last is lit.
    void waitUntilDone() const;

private:
    GreyVolume mField;  // the scene's, and its lumen: scenes come and go
    MaskVolume mRegion;
    TexelChoice mChoice;
    std::shared_ptr<IlluminationVolume> mLight;
    std::unique_ptr<TexelLighter> mLighter;
    std::vector<glm::vec3> mStraight;  // the sky's harmonics before it is turned; of irradiance none
    SkyTurn mTurn;
    std::array<glm::dvec3, 3> mPlace{};  // of the last frame: its eye and two rays
    std::uint64_t mLooks = 0;            // frames of which some pixels were looked at
    std::unique_ptr<LazyBake> mBake;     // last: it stops first
};

}  // namespace stereonav
