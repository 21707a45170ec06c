#include "engine/metrics/srgb_levels.h"

namespace stereonav {

const std::array<float, 1024>& srgbLevelFromPacked() {
    static const auto table = [] {
        std::array<float, 1024> t{};
        for (int i = 0; i < 1024; ++i) {
            const float root = static_cast<float>(i) / 1023.0f;
            t[static_cast<std::size_t>(i)] = 255.0f * srgbFromLinear(root * root);
        }
        return t;
    }();
    return table;
}

}  // namespace stereonav
