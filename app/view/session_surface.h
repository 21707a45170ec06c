// The look of a volume's surface: isovalue, transfer function, opacity, ambient light. Keys and panels change
// it, and it asks for a scene that shows it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/view/passing_notice.h"
#include "app/view/view_action.h"
#include "app/view/view_frame.h"
#include "engine/scene/capabilities.h"
#include "engine/volume/piece_choices.h"

namespace stereonav {

// Request for another scene: the same study with another look, or with its lumen found again from other
// pieces.
struct SceneChange {
    SurfaceChange surface;
    std::optional<PieceChoices> pieces;
};

class SessionSurface {
public:
    // scene and notice must outlive this object.
    SessionSurface(const std::shared_ptr<const OpenScene>& scene, PassingNotice& notice);

    // Executes a command; returns false for commands of others.
    bool act(ViewCommand command);
    SurfaceChange now() const;
    void set(const SurfaceChange& surface);
    bool hasIsovalue() const { return mIsovalue.has_value(); }
    // Returns the change that was asked for since the last call.
    std::optional<SceneChange> takeChange() { return std::exchange(mChange, std::nullopt); }
    // Returns to the scene's look, as the last change is not possible.
    void forgetChange();
    // Asks for a lumen of these pieces.
    void askForPieces(const PieceChoices& pieces);

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
    std::string mTransfer, mTriedTransfer;  // mTriedTransfer may have failed
    std::optional<AmbientChoice> mAmbient;
    std::string mMethodUnlit;  // method before ambient light was switched on
    std::optional<SceneChange> mChange;
};

}  // namespace stereonav
