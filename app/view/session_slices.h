// The slices of a session's study: when it is read, and the view of it, in which pieces of the lumen are
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
#include "app/view/worker.h"

namespace stereonav {

class SessionSlices {
public:
    // scene, notice: outlive this. eye: where one is, world.
    SessionSlices(const std::shared_ptr<const OpenScene>& scene, PassingNotice& notice,
                  std::function<glm::dvec3()> eye)
        : mScene(scene), mNotice(notice), mEye(std::move(eye)) {}

    // Does what the command says; false: it is another one's.
    bool act(ViewCommand command, SessionSurface& surface);

    // The study is read by the caller, whom takeStudyWish() tells once. Null until it is there.
    const std::shared_ptr<const SliceStudy>& study() const { return mStudy; }
    // It is read for panels, without the view.
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
    void turnPages(int by) { mView->turnPages(by); }  // shown() holds
    // Sets a seed where it is shown; x, y: pixels of the last picture. What to tell, "" for nothing.
    std::string click(double x, double y);
    // Another scene takes the place of this: what was chosen is not of it where it has other pieces.
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
    std::optional<PieceChoices> mChoices;  // when the view was left
    int mWidth = 1, mHeight = 1;           // pixels of the last picture
};

}  // namespace stereonav
