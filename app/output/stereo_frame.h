// One frame of the pipeline without a window: left eye, right eye, and one picture composed of them.
#pragma once

#include <string>

#include "app/output/place_names.h"
#include "app/scene/narrowed_eyes.h"
#include "app/scene/scene_loading.h"
#include "engine/base/hash.h"
#include "engine/frame/refined_frames.h"

namespace stereonav {

// Returns the pixels of a plane without the padding of its rows.
template <typename T>
void hashPlane(Hash& hash, const Plane<T>& plane) {
    for (int y = 0; y < plane.height(); ++y)
        hash.add(plane.row(y), sizeof(T) * static_cast<std::size_t>(plane.width()));
}

class StereoFrame {
public:
    // method: a method of the scene's FrameMaker, or "auto" for its default.
    StereoFrame(const Scene& scene, const std::string& method);
    // Chooses from options how the right eye is made, which warped pixels are cast in addition, and which
    // pixels get more than one ray; measures the scene where the options require it.
    void refine(const SceneOptions& options, const RayOptions& rays, Progress& progress);

    // Makes both eyes at a pose, with a separation that suits the room (NarrowedEyes). time: seconds, for
    // moving parts of the scene; not less than in the last call.
    void render(const Pose& head, double time = 0);
    // Moves on without a picture: the eyes come together as they would have with one.
    void passBy(const Pose& head, double time) { mStereo = mEyes.at(head, time); }
    // Paints the scene's surfaces in the last picture (engine/scene/surface_paint.h), and draws the names of
    // places; to be called once.
    void paint();

    // Return the views and eyes of the last picture.
    const StereoViews& views() const { return mViews; }
    const StereoSetting& stereo() const { return mStereo; }
    // Access for processing of both pictures as a whole.
    EyeImage& left() { return mFrame.left; }
    EyeImage& right() { return mFrame.right; }
    const EyeImage& left() const { return mFrame.left; }
    const EyeImage& right() const { return mFrame.right; }
    // Returns what refine() chose, "" where the options ask for nothing. madeIn(): the size in which eyes are
    // made before they are enlarged.
    const std::string& way() const { return mWayName; }
    const Lens& madeIn() const { return mLens; }
    bool isSmaller() const { return mLens.width < mScene.lens.width || mLens.height < mScene.lens.height; }
    const FrameTimings& timings() const { return mFrame.timings; }
    // Returns the rays per pixel of the last picture. expected_db(): PSNR against a picture of very many
    // rays; 0 with one ray.
    int rays() const { return mRays.many() ? mRefined.count() : 1; }
    double expected_db() const { return mRays.many() ? mRefined.error_db() : 0; }
    Plane<PackedColor> compose(OutputMode mode) const {
        return composeStereo(mFrame.left.color, mFrame.right.color, {mode, false, false});
    }

    // Adds colour and depth of both eyes, without padding.
    void addTo(Hash& hash) const;

private:
    void makeMany(const StereoViews& views, double time, EyePair& made);

    const Scene& mScene;
    std::string mMethod, mWayName;
    Lens mLens;
    FrameWay mWay;
    NarrowedEyes mEyes;
    StereoSetting mStereo;
    StereoViews mViews;  // in the size that was asked for
    RayOptions mRays;
    RefinedFrames mRefined;
    PlaceNames mNames;
    EyePair mFrame, mSmall;  // mSmall: the eyes as made, where they have fewer pixels
};

}  // namespace stereonav
