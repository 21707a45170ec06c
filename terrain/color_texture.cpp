#include "terrain/color_texture.h"

#include <algorithm>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

Plane<PackedColor> halved(const Plane<PackedColor>& fine) {
    Plane<PackedColor> coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2);
    for (int y = 0; y < coarse.height(); ++y) {
        const PackedColor* a = fine.row(2 * y);
        const PackedColor* b = fine.row(std::min(2 * y + 1, fine.height() - 1));
        for (int x = 0; x < coarse.width(); ++x) {
            const int x0 = 2 * x, x1 = std::min(2 * x + 1, fine.width() - 1);
            coarse.at(x, y) = packColor(
                0.25f * (unpackColor(a[x0]) + unpackColor(a[x1]) + unpackColor(b[x0]) + unpackColor(b[x1])));
        }
    }
    return coarse;
}

}  // namespace

ColorTexture::ColorTexture(const Plane<PackedColor>& image, glm::dvec2 gridOrigin, glm::dvec2 gridPerTexel)
    : mGridOrigin(gridOrigin), mGridPerTexel(gridPerTexel) {
    Plane<PackedColor> base(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y)
        std::copy_n(image.row(image.height() - 1 - y), image.width(), base.row(y));
    mLevels.push_back(std::move(base));
    while (mLevels.back().width() > 1 || mLevels.back().height() > 1)
        mLevels.push_back(halved(mLevels.back()));
}

std::size_t ColorTexture::byteCount() const {
    std::size_t bytes = 0;
    for (const auto& level : mLevels) bytes += level.byteCount();
    return bytes;
}

}  // namespace stereonav
