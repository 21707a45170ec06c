// The slices of a session's study: when it is read, and the slice view, in which pieces of the lumen are
// chosen.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/view/passing_notice.h"
#include "app/view/session_surface.h"
#include "app/view/slices.h"
#include "app/view/view_action.h"
#include "app/view/view_frame.h"

namespace stereonav {

class SessionSlices {
public:
    // scene and notice must outlive this object. eye: returns the eye's place in the world.
    SessionSlices(const std::shared_ptr<const OpenScene>& scene, PassingNotice& notice,
                  std::function<glm::dvec3()> eye)
        : mScene(scene), mNotice(notice), mEye(std::move(eye)) {}

    // Executes a command; returns false for commands of others.
    bool act(ViewCommand command, SessionSurface& surface);

    // Returns the study, which the caller reads after takeStudyWish(), which returns true once. Null until it
    // is there.
    const std::shared_ptr<const SliceStudy>& study() const { return mStudy; }
    // Asks for the study for panels, without the view.
    void wishStudy();
    bool takeStudyWish() { return std::exchange(mStudyWished, false); }
    void dropStudyWish() { mStudyWished = mViewWished = false; }
    void keepStudy(std::shared_ptr<const SliceStudy> study) { mStudy = std::move(study); }
    bool wantsView() const { return mViewWished; }

    bool shown() const { return mView.has_value(); }
    void show(std::shared_ptr<const SliceStudy> study);
    const Plane<PackedColor>& picture(int width, int height);
    long long version() const { return mView ? mView->version() : 0; }
    std::string status() const { return mView ? mView->status() : ""; }
    void turnPages(int by) { mView->turnPages(by); }  // requires shown()
    // Sets a seed at a pixel x, y of the last picture. Returns a notice, "" for none.
    std::string click(double x, double y);
    // Goes on in another scene: choices are dropped where it has other pieces.
    void replaceScene(const Scene& next);

private:
    void open();
    void close();

    const std::shared_ptr<const OpenScene>& mScene;
    PassingNotice& mNotice;
    std::function<glm::dvec3()> mEye;
    std::optional<SliceView> mView;
    std::shared_ptr<const SliceStudy> mStudy;
    bool mStudyWished = false, mViewWished = false;
    std::optional<PieceChoices> mChoices;  // kept when the view was left
    int mWidth = 1, mHeight = 1;           // pixels of the last picture
};

}  // namespace stereonav
