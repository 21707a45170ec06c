#include "app/view/panel/shown_panels.h"

#include <algorithm>

namespace stereonav {

void ShownPanels::toggleSide() {
    hidden = false;
    side.shown = !side.shown;
    if (!beside && side.shown) left.shown = false;
}

void ShownPanels::toggleLeft() {
    hidden = false;
    left.shown = !left.shown;
    if (!beside && left.shown) side.shown = false;
}

void ShownPanels::toggleUnfolded() {
    hidden = false;
    unfolded = !unfolded;
}

ShownPanels::Rest ShownPanels::rest(const glm::vec2& whole) const {
    if (!beside) return {{0, 0}, whole, above, below};
    const float high = strip > 0 ? whole.y - strip - below : whole.y;
    return {{left.taken, 0},
            {std::max(whole.x - left.taken - side.taken, 1.0f), std::max(high, 1.0f)},
            above,
            strip > 0 ? 0 : below};
}

}  // namespace stereonav
