// Light of a volume that is computed while it is shown: the background bake of a window's scene, with
// everything it refers to.
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
    // Sets scene's look to show the light. Irradiance is lit by --sky, or by bake's default; transfer is
    // baked as by bake. Throws Error, Cancelled.
    LazyLight(const SceneOptions& options, ColonScene& scene, Progress& progress);

    // Moves the surface to another isovalue, in stored numbers: lit texels stay, missing ones are lit next.
    // Any thread.
    void showSurface(float isovalue);

    // Returns whether the sky can turn, which needs transfer. turnTo(): to be called before a frame.
    bool turns() const { return !mStraight.empty(); }
    const SkyTurn& turn() const { return mTurn; }
    void turnTo(const SkyTurn& turn);

    // Lights the texels that a frame saw next; all of them when the frame comes again. Returns at once.
    void seen(const EyeView& view, const EyeImage& image);
    // Returns a number that grows as texels change, and while the last frame has to come again.
    std::uint64_t changes() const { return mBake->changes() + mLooks; }
    // Waits until all texels that were seen last are lit.
    void waitUntilDone() const;

private:
    GreyVolume mField;  // the scene's field and lumen, shared: scenes come and go
    MaskVolume mRegion;
    TexelChoice mChoice;
    std::shared_ptr<IlluminationVolume> mLight;
    std::unique_ptr<TexelLighter> mLighter;
    std::vector<glm::vec3> mStraight;  // harmonics of the sky before it is turned; empty for irradiance
    SkyTurn mTurn;
    std::array<glm::dvec3, 3> mPlace{};  // eye and two rays of the last frame
    std::uint64_t mLooks = 0;            // frames of which only some pixels were looked at
    std::unique_ptr<LazyBake> mBake;     // last member: it stops first
};

}  // namespace stereonav
