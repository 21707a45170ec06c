// The slice view: leafs through a study's slices and takes seeds by clicks. Lives while it is shown; the
// session owns it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/view/slice_picture.h"
#include "app/view/worker.h"
#include "engine/scene/slices.h"

namespace stereonav {

class SliceView {
public:
    // Opens at the slice through `eye` (world). seeds: to start with, world.
    SliceView(std::shared_ptr<const SliceStudy> study, const glm::dvec3& eye, std::vector<glm::dvec3> seeds);

    void nextAxis(const glm::dvec3& eye);  // goes to the slice through the eye, or the newest seed's
    void turnPages(int by);
    // x, y: continuous pixels of a picture of this size. "" beside the study, else what to tell.
    std::string click(double x, double y, int width, int height);
    void removeSeed();

    const std::vector<glm::dvec3>& seeds() const { return mSeeds; }
    const std::shared_ptr<const SliceStudy>& study() const { return mStudy; }
    SliceAxis axis() const { return mAxis; }
    int slice() const { return mSlice; }
    std::string status() const;
    // lumen may be null. Asked for again with the same arguments and nothing changed, nothing is drawn:
    // version() tells.
    const Plane<PackedColor>& picture(int width, int height, const glm::dvec3& eye,
                                      const std::shared_ptr<const OpenScene>& scene);
    long long version() const { return mVersion; }

private:
    SliceLayout layout(int width, int height) const { return {mStudy->grey.frame, mAxis, width, height}; }

    std::shared_ptr<const SliceStudy> mStudy;
    SliceAxis mAxis = SliceAxis::Axial;
    int mSlice = 0;
    std::vector<glm::dvec3> mSeeds;
    Plane<PackedColor> mPicture;
    std::shared_ptr<const OpenScene> mDrawnScene;
    glm::dvec3 mDrawnEye{0.0};
    bool mChanged = true;
    long long mVersion = 0;
};

// A seed as the command line takes it: LPS millimetres.
std::string seedText(const glm::dvec3& world);

}  // namespace stereonav
