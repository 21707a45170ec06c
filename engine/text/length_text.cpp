#include "engine/text/length_text.h"

#include <fmt/format.h>

#include <cmath>

namespace stereonav {

std::string lengthText(double metres) {
    if (metres >= 1000) return fmt::format("{:.2f} km", metres / 1000);
    if (std::abs(metres) < 0.1) return fmt::format("{:.1f} mm", metres * 1000);
    return fmt::format("{:.{}f} m", metres, metres >= 100 ? 0 : metres >= 10 ? 1 : 2);
}

}  // namespace stereonav
