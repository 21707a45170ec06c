// Holes, marked.
#include "engine/metrics/difference_picture.h"

#include "engine/base/error.h"

namespace stereonav {

Plane<PackedColor> holesInRed(const Plane<PackedColor>& image, const Plane<std::uint8_t>& holeMask) {
    if (holeMask.width() != image.width() || holeMask.height() != image.height())
        throw Error("", "", "expected a hole mask of the picture's size", "take both from the same frame");
    constexpr PackedColor kRed = 1023u;
    Plane<PackedColor> marked = image;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (holeMask.at(x, y) != 0) marked.at(x, y) = kRed;
    return marked;
}

}  // namespace stereonav
