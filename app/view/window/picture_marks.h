// Marks over the picture in depth, for each eye: the pointer, names of places, the measured line, findings.
#pragma once

#include <memory>
#include <vector>

#include "app/output/place_labels.h"
#include "app/view/frame_presenter.h"
#include "app/view/instruments.h"
#include "app/view/kept_places.h"
#include "app/view/window/panel_stage.h"
#include "app/view/window/picture_pointer.h"
#include "engine/display/eye_overlay.h"

namespace stereonav {

class PictureMarks {
public:
    // The arguments must outlive this object.
    PictureMarks(FramePresenter& pictures, const PicturePointer& pointer, const PanelStage& stage,
                 const KeptPlaces& kept, const Instruments& instruments)
        : mPictures(pictures), mPointer(pointer), mStage(stage), mKept(kept), mInstruments(instruments) {}

    // Draws the marks over the present picture. session: none before the first scene. Returns true where they
    // look different.
    bool draw(const std::optional<ViewSession>& session, const OutputModeInfo& mode);

private:
    std::vector<OverlayMark> marks(const ViewSession& session, const OutputModeInfo& mode);
    void addNames(const std::shared_ptr<const OpenScene>& scene, std::vector<OverlayMark>& marks);
    void addLine(std::vector<OverlayMark>& marks) const;
    const std::vector<LabelledPlace>& namedPlaces(const std::shared_ptr<const OpenScene>& scene);

    FramePresenter& mPictures;
    const PicturePointer& mPointer;
    const PanelStage& mStage;
    const KeptPlaces& mKept;
    const Instruments& mInstruments;
    EyeOverlay mOverlay;
    struct Names {
        std::weak_ptr<const OpenScene> of;
        int places = -1;  // versions
        long long paint = 0;
        std::vector<LabelledPlace> list;
    } mNames;
};

}  // namespace stereonav
