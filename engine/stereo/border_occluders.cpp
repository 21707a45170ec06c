// Asks the scene from large rectangles down to small tiles; most pictures answer no at the top.
#include "engine/stereo/border_occluders.h"

#include <algorithm>
#include <cmath>

#include "engine/stereo/work_queue.h"

namespace stereonav {
namespace {

constexpr int kTileWidth = 8, kTileHeight = 4;  // smallest tiles
constexpr int kStripHeight = 64;                // pixels a task starts from

struct Search {
    const EyeRenderer& renderer;
    const EyeView& view;
    double column, parallaxScale;
    Plane<std::uint8_t>& mask;
    EyeImage& right;
};

void markTile(const Search& search, PixelRect rect) {
    for (int y = rect.y0; y < rect.y1; ++y) {
        std::fill(search.mask.row(y) + rect.x0, search.mask.row(y) + rect.x1, std::uint8_t{255});
        std::fill(search.right.color.row(y) + rect.x0, search.right.color.row(y) + rect.x1, 0u);
        std::fill(search.right.viewDepth.row(y) + rect.x0, search.right.viewDepth.row(y) + rect.x1, 0.0f);
    }
}

// Half of [a, b) rounded up to whole tiles from the left or top.
int middle(int a, int b, int tile) {
    return a + ((b - a) / 2 + tile - 1) / tile * tile;
}

// freeDepth: up to which the rectangle is known to be free.
void searchRect(const Search& search, PixelRect rect, double freeDepth) {
    if (!search.renderer.mayHitBeyondEdgeFrom(search.view, rect, search.column, search.parallaxScale,
                                              freeDepth))
        return;
    const bool wide = rect.width() > kTileWidth, high = rect.height() > kTileHeight;
    if (!wide && !high) return markTile(search, rect);
    PixelRect first = rect, second = rect;
    if (wide && (!high || rect.width() >= 2 * rect.height()))
        first.x1 = second.x0 = middle(rect.x0, rect.x1, kTileWidth);
    else
        first.y1 = second.y0 = middle(rect.y0, rect.y1, kTileHeight);
    searchRect(search, first, freeDepth);
    searchRect(search, second, freeDepth);
}

}  // namespace

void markBorderOccluders(const EyeRenderer& renderer, const StereoViews& views, Plane<std::uint8_t>& mask,
                         EyeImage& right) {
    const EyeView& view = views.right;
    const double column = view.width + views.shiftAtInfinity;
    // Left of this column even a thing at the near distance lies inside the left eye's window.
    const double first = column - views.parallaxScale / view.nearDepth;
    if (first >= view.width) return;
    const int x0 = static_cast<int>(std::max(0.0, std::floor(first)));
    const Search search{renderer, view, column, views.parallaxScale, mask, right};
    const int strips = (view.height + kStripHeight - 1) / kStripHeight;
    forEachPiece(strips, Schedule::Dynamic, [&](int, int strip) {
        const int y0 = strip * kStripHeight;
        searchRect(search, {x0, y0, view.width, std::min(y0 + kStripHeight, view.height)}, 0);
    });
}

}  // namespace stereonav
