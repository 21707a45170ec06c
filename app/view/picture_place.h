// Where the eyes' pictures and the interface lie in the window, whatever the layout: each eye has a part of
// it, and beside panels the picture has the rest of that part.
#pragma once

#include "app/options/shared_options.h"
#include "app/view/panel/panels.h"
#include "engine/display/interface.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

// The parts of both eyes, one where they share one.
InterfacePlaces interfacePlaces(const OutputModeInfo& mode);

// Whether the parts of both eyes leave nothing of a window of so many pixels, as an odd column or the gap
// between packed frames.
bool partsCover(OutputMode mode, const SizeOption& window);

// Of one part, pixels from its top left corner.
struct PicturePlace {
    glm::ivec2 part{1}, corner{0}, size{1};
    bool operator==(const PicturePlace&) const = default;
};
// window: pixels of the framebuffer; rest: what the interface leaves, of a whole of `units`.
PicturePlace picturePlace(const OutputModeInfo& mode, const glm::ivec2& window, const Panels::Rest& rest,
                          const glm::vec2& units);
// Pixels of a picture composed of both eyes that fills it in all parts.
glm::ivec2 composedAt(const OutputModeInfo& mode, const PicturePlace& place);
// Pixels of an eye that fills it.
SizeOption eyeSizeAt(const OutputModeInfo& mode, const PicturePlace& place);
// Where in an eye's picture a place of the window lies, in shares of its size; beside it less than 0 or more
// than 1.
glm::dvec2 placeInPicture(const OutputModeInfo& mode, const PicturePlace& place, const glm::dvec2& window);

}  // namespace stereonav
