// Both eyes of a medium by sweeps.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "app/medium_scene.h"
#include "app/pair_renderer.h"
#include "engine/medium/medium_sweep.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

class MediumRenderer final : public PairRenderer {
public:
    // scene must outlive this; its look is read at each frame.
    explicit MediumRenderer(const MediumScene& scene, SimdTarget simd = SimdTarget::Auto);

    PairTimings renderPair(const StereoViews& views, double time, PairMethod method, EyeImage& left,
                           EyeImage& right) override;
    void renderOne(const EyeView& view, double time, EyeImage& image) override;

    SimdTarget target() const { return mSweep.target(); }
    // Held between frames: what sweeps read and write, and their pictures before they are packed.
    std::size_t sweepBytes() const;
    std::size_t pictureBytes() const;

private:
    class RightRays;
    glm::vec3 behind(const EyeView& view, int x, int y) const;
    void pack(const MediumPicture& picture, const EyeView& view, EyeImage& image) const;
    void sweepOne(const EyeView& view, double time, std::span<const Plane<float>> starts, EyeImage& image);

    // Of the medium that the look's model shows.
    MediumSweep& sweep();

    struct Surface {
        Medium medium;
        MediumSweep sweep;
        Surface(Medium made, SimdTarget simd) : medium(std::move(made)), sweep(medium, simd) {}
    };

    const MediumScene& mScene;
    MediumSweep mSweep;
    std::unique_ptr<Surface> mSurface;  // made when it is first shown
    RightEye mSplat;
    std::vector<MediumPicture> mPictures;
};

}  // namespace stereonav
