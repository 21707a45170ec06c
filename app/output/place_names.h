// Names of the places that a scene's paint marks (engine/render/paint_legend.h), drawn over both finished
// eyes of pictures and videos: never warped, but projected for each eye. The window draws them by OpenGL
// (engine/display/eye_overlay.h).
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
    // Returns the height of letters in pixels: a fortieth of the picture's, within the limits of Letters.
    static int letterHeight(int pictureHeight);

    // Draws the names that labelsInView() chooses (app/output/place_labels.h), where it puts them. frame:
    // both eyes of these views, with the depths of the left one. Does nothing where no place has a name.
    void draw(const std::vector<PaintedPlace>& places, const StereoViews& views, EyePair& frame);

private:
    std::optional<Letters> mLetters;  // letters for the size of the last picture
};

}  // namespace stereonav
