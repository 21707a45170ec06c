// The names of the places that a scene's paint marks (engine/render/paint_legend.h), drawn over both finished
// eyes of pictures and videos: never warped, each eye by its own projection. The window draws its own, by
// OpenGL (engine/display/eye_overlay.h).
#pragma once

#include <optional>
#include <vector>

#include "engine/camera/stereo_rig.h"
#include "engine/frame/frame_maker.h"
#include "engine/letters/letters.h"
#include "engine/render/paint_legend.h"

namespace stereonav {

class PlaceNames {
public:
    // Pixels of letters in a picture so high: a fortieth, within the bounds of Letters.
    static int letterHeight(int pictureHeight);

    // frame: both eyes of these views, with the left one's depths. Which names are drawn and where they stand
    // is labelsInView's to say (app/output/place_labels.h). Nothing is made where no place has a name.
    void draw(const std::vector<PaintedPlace>& places, const StereoViews& views, EyePair& frame);

private:
    std::optional<Letters> mLetters;  // of the last picture's size
};

}  // namespace stereonav
