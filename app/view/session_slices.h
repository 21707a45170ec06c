// The slices of a session's study: reads the study when it is wanted, and keeps the slice view, in which the
// user chooses pieces of the lumen.
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

    // Executes a command of the slices; returns false for other commands.
    bool act(ViewCommand command, SessionSurface& surface);

    // Returns the study; null until keepStudy() was called. A caller reads the study when takeStudyWish()
    // returns true, which it does once for each wish.
    const std::shared_ptr<const SliceStudy>& study() const { return mStudy; }
    // Asks for the study without opening the slice view, for panels.
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
    // Called before another scene replaces the present one. Drops the choices of pieces unless both scenes
    // have the same.
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
