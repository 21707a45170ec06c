// Parts and pictures of Butteraugli's map; the map itself is asked of the module stereonav_jxl.
#include "engine/metrics/butteraugli.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/metrics/butteraugli_module.h"

namespace stereonav {
namespace {

const ButteraugliFunctions& jxl() {
    static const auto& functions =
        moduleFunctions<ButteraugliFunctions>("jxl", "to measure differences as a person sees them");
    return functions;
}

// The mean of the 3-, 6- and 12-norms, each of the mean power.
class Norm {
public:
    void add(double distance) {
        const double cube = distance * distance * distance;
        mSums[0] += cube;
        mSums[1] += cube * cube;
        mSums[2] += cube * cube * cube * cube;
        ++mCount;
    }
    double value() const {
        if (mCount == 0) return std::numeric_limits<double>::quiet_NaN();
        double norms = 0;
        for (int k = 0; k < 3; ++k) norms += std::pow(mSums[k] / static_cast<double>(mCount), 1.0 / (3 << k));
        return norms / 3;
    }

private:
    double mSums[3] = {0, 0, 0};
    long long mCount = 0;
};

}  // namespace

ButteraugliMap butteraugliOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image) {
    if (truth.empty() || truth.width() != image.width() || truth.height() != image.height())
        throw Error("", "", "expected two pictures of one size to compare", "render both at the same size");
    return jxl().butteraugliOf(truth, image);
}

ButteraugliParts partsOf(const Plane<float>& distances, const Plane<std::uint8_t>& mask) {
    if (distances.width() != mask.width() || distances.height() != mask.height())
        throw Error("", "", "expected a mask of the map's size", "make both from the same frame");
    Norm inside, outside;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) (mask.at(x, y) ? inside : outside).add(distances.at(x, y));
    return {inside.value(), outside.value()};
}

Plane<PackedColor> pictureOf(const Plane<float>& distances) {
    Plane<PackedColor> picture(distances.width(), distances.height());
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const float grey = std::clamp(distances.at(x, y) / 2, 0.0f, 1.0f);
            picture.at(x, y) = packColor(glm::vec3(linearFromSrgb(grey)));
        }
    return picture;
}

}  // namespace stereonav
