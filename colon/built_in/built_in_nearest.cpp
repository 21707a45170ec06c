// Finds the nearest place on the axis of the built-in colon.
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "colon/built_in/built_in_anatomy.h"

namespace stereonav {

int BuiltInAnatomy::nearest(const glm::dvec3& p, const int* candidates, int count) const {
    int best = candidates[0];
    double least = 1e30;
    for (int n = 0; n < count; ++n) {
        const AxisPoint& point = mAxis[candidates[n]];
        const glm::dvec3 to = p - point.place;
        const double value = std::sqrt(glm::dot(to, to)) - point.radius;
        if (value < least) {
            least = value;
            best = candidates[n];
        }
    }
    return best;
}

BuiltInAnatomy::Place BuiltInAnatomy::placeOf(const glm::dvec3& p) const {
    std::vector<int> all(mAxis.size());
    for (int n = 0; n < static_cast<int>(all.size()); ++n) all[n] = n;
    return placeOf(p, all.data(), static_cast<int>(all.size()));
}

}  // namespace stereonav
