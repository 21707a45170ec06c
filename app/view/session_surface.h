// How a volume's surface is shown: isovalue, transfer function, opacity, ambient light. Keys and panels
// change it, and it asks for a scene that shows it so.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/view/passing_notice.h"
#include "app/view/view_action.h"
#include "app/view/worker.h"
#include "engine/scene/capabilities.h"

namespace stereonav {

// Another scene that the user asks for: the same study, seen differently, or with its lumen found again of
// other pieces.
struct SceneChange {
    SurfaceChange surface;
    std::optional<PieceChoices> pieces;
};

class SessionSurface {
public:
    // Both outlive this.
    SessionSurface(const std::shared_ptr<const OpenScene>& scene, PassingNotice& notice);

    // Does what the command says; false: it is another one's.
    bool act(ViewCommand command);
    SurfaceChange now() const;
    void set(const SurfaceChange& surface);
    bool hasIsovalue() const { return mIsovalue.has_value(); }
    // What was asked for since the last call.
    std::optional<SceneChange> takeChange() { return std::exchange(mChange, std::nullopt); }
    // The last change can not be done: what the scene shows counts again.
    void forgetChange();
    // The lumen is to be found again of these.
    void askForPieces(const PieceChoices& pieces);
    std::string text() const;  // for the status line

private:
    const SurfaceChoices* choices() const { return mScene->scene->offered<SurfaceChoices>(); }
    bool actOnAmbient(ViewCommand command);
    void take();
    void askForChange();
    void moveIsovalue(double steps);
    void nextTransfer();
    void stepAmbient(int by);
    void scaleRadius(double factor);
    void nextModulation();
    void scaleSigma(double factor);
    double sigmaNow() const;
    std::string ambientText() const;
    std::string modulationText() const;

    const std::shared_ptr<const OpenScene>& mScene;
    PassingNotice& mNotice;
    std::optional<double> mIsovalue;
    bool mTranslucent = false;
    std::string mTransfer, mTriedTransfer;  // the second may not have gone
    std::optional<AmbientChoice> mAmbient;
    std::string mMethodUnlit;  // its method, before ambient light was turned on
    std::optional<SceneChange> mChange;
};

}  // namespace stereonav
