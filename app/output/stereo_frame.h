// One frame of the pipeline without a window: left eye, right eye, one picture for the display.
#pragma once

#include <string>

#include "app/output/place_names.h"
#include "app/scene/narrowed_eyes.h"
#include "app/scene/scene_loading.h"
#include "engine/base/hash.h"
#include "engine/frame/refined_frames.h"

namespace stereonav {

// The pixels of a plane, without what pads its rows.
template <typename T>
void hashPlane(Hash& hash, const Plane<T>& plane) {
    for (int y = 0; y < plane.height(); ++y)
        hash.add(plane.row(y), sizeof(T) * static_cast<std::size_t>(plane.width()));
}

class StereoFrame {
public:
    // method: one of the scene's FrameMaker, or "auto" for its default.
    StereoFrame(const Scene& scene, const std::string& method);
    // How the right eye is made, which warped pixels are cast as well, and where more rays than one go
    // through a pixel, from options; measures the scene where they ask for it.
    void refine(const SceneOptions& options, const RayOptions& rays, Progress& progress);

    // Both eyes at one pose, as far apart as suits the room there (NarrowedEyes). time: seconds, of what
    // moves by itself; no less than before.
    void render(const Pose& head, double time = 0);
    // Flies past without a picture: eyes come together as they would have with one.
    void passBy(const Pose& head, double time) { mStereo = mEyes.at(head, time); }
    // What the scene's surfaces are painted with (engine/scene/surface_paint.h), over the last picture, and
    // the names of places that it marks; once.
    void paint();

    // Those of the last picture.
    const StereoViews& views() const { return mViews; }
    const StereoSetting& stereo() const { return mStereo; }
    // Of what is worked out for the two pictures as a whole.
    EyeImage& left() { return mFrame.left; }
    EyeImage& right() { return mFrame.right; }
    const EyeImage& left() const { return mFrame.left; }
    const EyeImage& right() const { return mFrame.right; }
    // What refine() chose, "" where nothing was wished; and the size in which eyes are made, to be enlarged.
    const std::string& way() const { return mWayName; }
    const Lens& madeIn() const { return mLens; }
    bool isSmaller() const { return mLens.width < mScene.lens.width || mLens.height < mScene.lens.height; }
    const FrameTimings& timings() const { return mFrame.timings; }
    // Of the last picture: rays a pixel, and how near it is expected to be to one of very many; 0 of one ray.
    int rays() const { return mRays.many() ? mRefined.count() : 1; }
    double expected_db() const { return mRays.many() ? mRefined.error_db() : 0; }
    Plane<PackedColor> compose(OutputMode mode) const {
        return composeStereo(mFrame.left.color, mFrame.right.color, {mode, false, false});
    }

    // Colour and depth of both eyes, pixels only.
    void addTo(Hash& hash) const;

private:
    void makeMany(const StereoViews& views, double time, EyePair& made);

    const Scene& mScene;
    std::string mMethod, mWayName;
    Lens mLens;
    FrameWay mWay;
    NarrowedEyes mEyes;
    StereoSetting mStereo;
    StereoViews mViews;  // with the size asked for
    RayOptions mRays;
    RefinedFrames mRefined;
    PlaceNames mNames;
    EyePair mFrame, mSmall;  // mSmall: as made, where that is in fewer pixels
};

}  // namespace stereonav
