#include "engine/sampling/pixel_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "engine/base/error.h"

namespace stereonav {
namespace {

// Rows of a lattice whose column i has row m (i + 1) mod (count + 1) - 1: a permutation where m and count + 1
// have no common divisor.
glm::dvec2 latticePlace(int count, int m, int i) {
    const int row = m * (i + 1) % (count + 1) - 1;
    return {(i + 0.5) / count - 0.5, (row + 0.5) / count - 0.5};
}

double squareApart(const glm::dvec2& a, const glm::dvec2& b) {
    const auto around = [](double d) { return d - std::round(d); };  // the next pixel has the same places
    const double x = around(a.x - b.x), y = around(a.y - b.y);
    return x * x + y * y;
}

// Less where the places lie further apart: the energy of charges that repel each other.
double crowding(int count, int m) {
    double sum = 0;
    for (int i = 1; i < count; ++i)
        for (int j = 0; j < i; ++j)
            sum += 1 / squareApart(latticePlace(count, m, i), latticePlace(count, m, j));
    return sum;
}

}  // namespace

std::vector<glm::dvec2> rotatedGrid(int count) {
    if (count < 1 || count > 64)
        throw Error("", "", "expected 1 to 64 rays in a pixel, got " + std::to_string(count),
                    "use 4 for a rotated grid");
    int best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (int m = 1; m <= count; ++m) {
        if (std::gcd(m, count + 1) != 1) continue;
        if (const double crowded = crowding(count, m); crowded < least * (1 - 1e-9))
            best = m, least = crowded;
    }
    std::vector<glm::dvec2> places;
    places.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) places.push_back(latticePlace(count, best, i));
    return places;
}

glm::dvec2 evenPlace(long long k) {
    constexpr double kPlastic = 1.32471795724474602596;
    const auto place = [k](double step) {
        const double at = 0.5 + static_cast<double>(k) * step;
        return at - std::floor(at) - 0.5;
    };
    return {place(1 / kPlastic), place(1 / (kPlastic * kPlastic))};
}

EyeView shiftedBy(const EyeView& view, const glm::dvec2& offset) {
    EyeView shifted = view;
    const double x = offset.x * view.pixelWidth(), y = offset.y * view.pixelHeight();
    shifted.xMin += x;
    shifted.xMax += x;
    shifted.yMin -= y;
    shifted.yMax -= y;
    return shifted;
}

StereoViews shiftedBy(const StereoViews& views, const glm::dvec2& offset) {
    StereoViews shifted = views;
    shifted.left = shiftedBy(views.left, offset);
    shifted.right = shiftedBy(views.right, offset);
    return shifted;
}

}  // namespace stereonav
