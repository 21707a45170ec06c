// The four ways to two eyes of a medium, and what is put behind it.
#include "engine/medium/sweep/swept_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"

namespace stereonav {

// The right eye as a renderer for the warp by splats: one tile, swept from the depths that the warp gives.
class SweptFrames::RightRays final : public EyeRenderer {
public:
    // nearest: view depth in metres before which nothing is expected outside the left eye's picture.
    RightRays(SweptFrames& renderer, double time, double nearest)
        : mRenderer(renderer), mTime(time), mNearest(nearest) {}

    int tileCount(const EyeView&) const override { return 1; }
    void renderTile(const EyeView& view, int, EyeImage& image) const override {
        mRenderer.sweepOne(view, mTime, {}, image);
    }
    // A sweep makes whole pictures, not single rays.
    void renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex>,
                      EyeImage& image) const override {
        renderTile(view, 0, image);
    }
    bool mayHitBeyondEdge(const EyeView&, PixelRect rect, double column,
                          double parallaxScale) const override {
        return rect.x1 >= column || parallaxScale / (column - rect.x1) > mNearest;
    }
    bool translucent() const override { return true; }
    void renderTileFromDepth(const EyeView& view, int, EyeImage& image) const override {
        Plane<float> starts;
        std::swap(starts, image.viewDepth);
        image.viewDepth.resize(view.width, view.height);
        mRenderer.sweepOne(view, mTime, {&starts, 1}, image);
    }

private:
    SweptFrames& mRenderer;
    double mTime, mNearest;
};

// Returns the view depth before which nothing is expected beyond the edge of the left eye's picture: the
// nearest depth in it, less a margin. A medium can not be asked for more, unlike a scene with surfaces.
double nearestExpected(const EyeImage& left) {
    constexpr float kMargin = 0.9f;
    float nearest = kMissDepth;
    for (int y = 0; y < left.height(); ++y)
        for (int x = 0; x < left.width(); ++x) nearest = std::min(nearest, left.viewDepth.at(x, y));
    return kMargin * nearest;
}

SweptFrames::SweptFrames(const MediumScene& scene, SimdTarget simd)
    : mScene(scene), mSweep(scene.medium, simd), mPictures(2) {}

std::vector<HeldBytes> SweptFrames::held() const {
    std::size_t pixels = 0;
    for (const MediumPicture& picture : mPictures)
        pixels += static_cast<std::size_t>(picture.light.width()) * picture.light.height();
    return {{"sweep", mSweep.heldBytes() + (mSurface ? mSurface->sweep.heldBytes() : 0)},
            {"pictures", pixels * (sizeof(glm::vec4) + sizeof(float))}};
}

bool SweptFrames::showsSurface() const {
    return mScene.look.model == MediumModel::Surface && mScene.makeSurface;
}

const Medium& SweptFrames::medium() const {
    return showsSurface() ? mSurface->medium : mScene.medium;
}

MediumSweep& SweptFrames::sweep() {
    if (!showsSurface()) return mSweep;
    if (!mSurface) mSurface = std::make_unique<Surface>(mScene.makeSurface(), mSweep.target());
    return mSurface->sweep;
}

glm::vec3 SweptFrames::behind(const EyeView& view, int x, int y) const {
    return mScene.sky ? mScene.sky(glm::normalize(view.rayDirection(x + 0.5, y + 0.5)))
                      : mScene.look.background;
}

void SweptFrames::pack(const MediumPicture& picture, const EyeView& view, EyeImage& image) const {
    image.resize(view.width, view.height);
    parallelFor(view.height, [&](int y) {
        for (int x = 0; x < view.width; ++x) {
            const glm::vec4 seen = picture.light.at(x, y);
            glm::vec3 light(seen);
            if (seen.w > 0) light += seen.w * behind(view, x, y);
            image.color.at(x, y) = packColor(mScene.tone(light));
            image.viewDepth.at(x, y) = picture.viewDepth.at(x, y);
        }
    });
}

void SweptFrames::sweepEyes(std::span<const EyeView> eyes, double time, std::span<const Plane<float>> starts,
                            bool shares) {
    MediumSweep& sweep = this->sweep();
    SweepSetting setting = mScene.sweep;
    setting.turn = mTurn;
    if (!shares) setting.sharedWidth = 0;
    if (mEffort != 1) {
        constexpr int kFewestSlices = 16, kFewestTexels = 32, kMostSlices = 65536, kMostTexels = 4096;
        const auto times = [](int all, double share, int fewest, int most) {
            const double wanted = std::min(share * all, 1.0 * most);
            return std::max(std::min(all, fewest), static_cast<int>(wanted));
        };
        setting.slices = times(setting.slices, mEffort, kFewestSlices, kMostSlices);
        setting.lightSize = times(setting.lightSize, std::sqrt(mEffort), kFewestTexels, kMostTexels);
    }
    const glm::dvec3& head = eyes[0].head;
    const std::span<MediumPicture> pictures(mPictures.data(), eyes.size());
    const auto cpu = [&] { sweep.render(mScene.look, setting, eyes, head, time, pictures, starts); };
    mElsewhere = false;
    if (!mChooser || mHere || !starts.empty()) return cpu();
    mElsewhere = mChooser({medium(), mScene.look, setting, eyes, head, time, pictures}, cpu);
}

void SweptFrames::sweepOne(const EyeView& view, double time, std::span<const Plane<float>> starts,
                           EyeImage& image) {
    sweepEyes({&view, 1}, time, starts);
    pack(mPictures[0], view, image);
}

void SweptFrames::makeOne(const EyeView& view, double time, EyePair& frame) {
    const Stopwatch watch;
    mHere = false;
    sweepOne(view, time, {}, frame.left);
    frame.right = {};
    frame.timings = {};
    frame.timings.both_ms = frame.timings.left_ms = watch.elapsed_ms();
}

void SweptFrames::make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) {
    const std::string_view method = way.method.empty() ? defaultMethod() : way.method;
    if (std::find(kSweepMethods.begin(), kSweepMethods.end(), method) == kSweepMethods.end())
        throw Error("", "", "there is no method \"" + std::string(method) + "\" of sweeping both eyes",
                    "use one of methods()");
    frame.timings = {};
    const Stopwatch watch;
    mHere = method == kDepthSplatMethod;
    if (method == kSweepMethod || method == kOwnSamplesMethod) {
        const std::array<EyeView, 2> eyes{views.left, views.right};
        sweepEyes(eyes, time, {}, method == kSweepMethod);
        pack(mPictures[0], views.left, frame.left);
        pack(mPictures[1], views.right, frame.right);
        frame.timings.both_ms = watch.elapsed_ms();
        return;
    }
    frame.left.resize(views.left.width, views.left.height);
    sweepOne(views.left, time, {}, frame.left);
    frame.timings.left_ms = watch.elapsed_ms();
    WarpSetting setting;
    setting.method = method == kDepthSplatMethod ? RightEyeMethod::DepthSplat : RightEyeMethod::Full;
    const RightRays rays(*this, time, nearestExpected(frame.left));
    const RightEyeTimings ofRight = mSplat.render(rays, views, frame.left, setting, frame.right);
    frame.timings.both_ms = watch.elapsed_ms();
    frame.timings.right_ms = frame.timings.both_ms - frame.timings.left_ms;
    if (method == kDepthSplatMethod) frame.timings.warped = ofRight;
}

}  // namespace stereonav
