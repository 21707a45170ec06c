// Places of the eyes' pictures and of the interface in the window for each layout: each eye has a part of it,
// and the picture has the part that panels leave.
#pragma once

#include "app/options/shared_options.h"
#include "app/view/panel/shown_panels.h"
#include "engine/display/interface.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

// Returns the parts of both eyes, one where they share one.
InterfacePlaces interfacePlaces(const OutputModeInfo& mode);

// Returns whether the parts of both eyes cover a window of this size; an odd column, or the gap between
// packed frames, may be left.
bool partsCover(OutputMode mode, const SizeOption& window);

// The picture in one part of the window; pixels from the part's top left corner.
struct PicturePlace {
    glm::ivec2 part{1}, corner{0}, size{1};
    bool operator==(const PicturePlace&) const = default;
};
// window: pixels of the framebuffer; rest: what the interface leaves of `units`.
PicturePlace picturePlace(const OutputModeInfo& mode, const glm::ivec2& window, const ShownPanels::Rest& rest,
                          const glm::vec2& units);
// Returns the size in pixels of a picture composed of both eyes that fills the place in all parts.
glm::ivec2 composedAt(const OutputModeInfo& mode, const PicturePlace& place);
// Returns the size in pixels of an eye that fills the place.
SizeOption eyeSizeAt(const OutputModeInfo& mode, const PicturePlace& place);
// Returns the place in an eye's picture of a place in the window, in shares of the picture's size; outside it
// less than 0 or more than 1.
glm::dvec2 placeInPicture(const OutputModeInfo& mode, const PicturePlace& place, const glm::dvec2& window);

}  // namespace stereonav
