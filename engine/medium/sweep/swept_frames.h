// Frames of media, from sweeps on the CPU or by a function that replaces them.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/frame/frame_maker.h"
#include "engine/frame/sliced_frames.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/medium/sweep/medium_sweep.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// Arguments of a sweep. pictures: one for each eye.
struct SweepTask {
    const Medium& medium;
    const MediumLook& look;
    const SweepSetting& setting;
    std::span<const EyeView> eyes;
    const glm::dvec3& head;  // world, metres
    double time;             // seconds
    std::span<MediumPicture> pictures;
};
// Sweeps elsewhere and returns true, or calls cpu(), which sweeps here, and returns false.
using SweepChooser = std::function<bool(const SweepTask& task, const std::function<void()>& cpu)>;

// Methods of SweptFrames.
constexpr std::string_view kSweepMethod =
    "sweep";  // both eyes in one, from one light; the right reads what the left saw
constexpr std::string_view kOwnSamplesMethod =
    "own-samples";  // the same, but that each eye takes samples of its own
constexpr std::string_view kTwoSweepsMethod =
    "two-sweeps";  // one for each eye: what the others are measured against
// Splats the left eye's depths to the right eye, whose rays start there (W12 of docs/ledger.md).
// FrameTimings::warped has the splat, the sweep after it, and the rays without a known start.
constexpr std::string_view kDepthSplatMethod = "depthsplat";
constexpr std::array<std::string_view, 4> kSweepMethods{kSweepMethod, kOwnSamplesMethod, kTwoSweepsMethod,
                                                        kDepthSplatMethod};

class SweptFrames final : public FrameMaker, public SlicedFrames {
public:
    // scene must outlive this object; its look is read for each frame.
    explicit SweptFrames(const MediumScene& scene, SimdTarget simd = SimdTarget::Auto);

    std::span<const std::string_view> methods() const override { return kSweepMethods; }
    std::string_view defaultMethod() const override { return kSweepMethod; }
    std::string_view exactMethod() const override { return kTwoSweepsMethod; }
    std::string_view whatMethodsMake() const override { return "both eyes"; }
    void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) override;
    void makeOne(const EyeView& view, double time, EyePair& frame) override;
    // Lists the memory of sweeps, and of their pictures before they are packed.
    std::vector<HeldBytes> held() const override;

    // Sets the function that chooses where the coming sweeps run, except sweeps after a splat of depths.
    void setSweep(SweepChooser chooser) { mChooser = std::move(chooser); }
    bool sweptElsewhere() const { return mElsewhere; }  // the last one

    void setEffort(double share) override { mEffort = share; }
    void setTurn(double turn) override { mTurn = turn; }

    SimdTarget target() const { return mSweep.target(); }

private:
    class RightRays;
    glm::vec3 behind(const EyeView& view, int x, int y) const;
    void pack(const MediumPicture& picture, const EyeView& view, EyeImage& image) const;
    void sweepEyes(std::span<const EyeView> eyes, double time, std::span<const Plane<float>> starts,
                   bool shares = true);
    void sweepOne(const EyeView& view, double time, std::span<const Plane<float>> starts, EyeImage& image);

    // Returns whether the look's model shows a surface of the medium.
    bool showsSurface() const;
    MediumSweep& sweep();
    const Medium& medium() const;  // once sweep() was called

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
    double mEffort = 1, mTurn = 0;           // the same as in SlicedFrames
    bool mHere = false, mElsewhere = false;  // the chooser is not asked; it swept elsewhere
    SweepChooser mChooser;                   // last: it ends before the media that it was asked for
};

}  // namespace stereonav
