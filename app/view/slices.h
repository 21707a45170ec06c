// The slice view: leafs through a study's slices, and takes or leaves out pieces by clicks. Exists while it
// is shown; owned by the session.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/view/slice_picture.h"
#include "app/view/view_frame.h"
#include "engine/scene/slices.h"

namespace stereonav {

class SliceView {
public:
    // Opens at the slice through `eye` (world). choices: those to begin with.
    SliceView(std::shared_ptr<const SliceStudy> study, const glm::dvec3& eye, const PieceChoices& choices);

    void nextAxis(const glm::dvec3& eye);  // goes to the slice through the eye, or that of the newest choice
    void turnPages(int by);
    // Leaves out a piece that was taken, or the other way round. x, y: pixels with fractions of a picture of
    // this size. Returns a notice; "" outside the study.
    std::string click(double x, double y, int width, int height, const OpenScene& scene);
    void removeChoice();  // removes the newest choice

    PieceChoices choices() const;
    const std::shared_ptr<const SliceStudy>& study() const { return mStudy; }
    SliceAxis axis() const { return mAxis; }
    int slice() const { return mSlice; }
    std::string status() const;
    // Returns the picture; drawn again only where arguments or choices have changed, which version() shows.
    const Plane<PackedColor>& picture(int width, int height, const glm::dvec3& eye,
                                      const std::shared_ptr<const OpenScene>& scene);
    long long version() const { return mVersion; }

private:
    struct Choice {
        glm::dvec3 place{0.0};  // in the world
        bool taken = false;
    };

    SliceLayout layout(int width, int height) const { return {mStudy->grey.frame, mAxis, width, height}; }
    glm::ivec3 voxelAt(const glm::dvec3& world) const;
    int pieceAt(const glm::dvec3& world) const { return mStudy->pieces.at(voxelAt(world)); }
    std::vector<PackedColor> tints(const MaskVolume* lumen) const;

    std::shared_ptr<const SliceStudy> mStudy;
    SliceAxis mAxis = SliceAxis::Axial;
    int mSlice = 0;
    std::vector<Choice> mChoices;  // at most one per piece
    Plane<PackedColor> mPicture;
    std::shared_ptr<const OpenScene> mDrawnScene;
    glm::dvec3 mDrawnEye{0.0};
    bool mChanged = true;
    long long mVersion = 0;
};

}  // namespace stereonav
