// A picture of a volume whose every pixel is path traced, in both eyes: the reference for baked light.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/options/scene_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/camera/stereo_rig.h"
#include "engine/image/eye_image.h"
#include "engine/light/paths/pixel_path.h"
#include "engine/scene/capabilities.h"

namespace stereonav {

// Returns the method for the right eye: "full" where --light asks for path tracing, else `method`.
std::string methodUnderLight(const SceneOptions& options, const std::string& method);

class TracedLight final : public PictureLight {
public:
    // Lights the scene by --sky (a picture all around, or a colour) and --point-light, or by bake's default.
    // scene must outlive this object. Throws Error.
    TracedLight(const SceneOptions& options, const ColonScene& scene);

    void light(const StereoViews& views, EyeImage& left, EyeImage& right, Progress& progress) override;

    const std::vector<std::string>& notes() const override { return mNotes; }

private:
    const VolumeOptions mOptions;
    const ColonScene& mScene;
    int mSamples;
    std::vector<std::string> mNotes;
    std::unique_ptr<PixelPaths> mPaths;
};

}  // namespace stereonav
