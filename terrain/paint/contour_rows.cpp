#include "terrain/paint/contour_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

namespace stereonav {
namespace {

constexpr double kMostCells = 1 << 30, kMostLines = 1 << 22;
constexpr double kEdgeRoom = 1e-3;  // the same as in GroundView

template <typename Vector>
void setFloats(float (&out)[3], const Vector& v) {
    for (int k = 0; k < 3; ++k) out[k] = static_cast<float>(v[k]);
}

ContourShape shapeOfLines() {
    ContourShape shape;
    shape.width = kContourWidth, shape.indexWidth = kIndexContourWidth;
    shape.share = kContourShare, shape.indexShare = kIndexContourShare;
    shape.gone = kContourGone, shape.whole = kContourWhole;
    shape.index = kIndexContour;
    shape.reach = kContourReach, shape.level = kContourLevel;
    std::copy_n(kContourInk, 3, shape.ink);
    return shape;
}

}  // namespace

const ContourRows::Kernels& ContourRows::kernelsFor(SimdTarget target) {
    static const Kernels plainSet{plain::findLinePixels, plain::shareOfLines, plain::inkLines},
        avx2Set{avx2::findLinePixels, avx2::shareOfLines, avx2::inkLines},
        avx512Set{avx512::findLinePixels, avx512::shareOfLines, avx512::inkLines};
    return kernelsOf(target, plainSet, avx2Set, avx512Set);
}

ContourRows::ContourRows(const Heightfield& ground, const Fog& fog, const ContourSetting& setting,
                         const EyeView& view, SimdTarget target)
    : mFog(fog), mView(view), mSetting(setting), mGround(ground, view), mKernels(kernelsFor(target)) {
    const double interval = setting.interval, scale = setting.verticalScale;
    const double indexInterval = kIndexContour * interval;
    const glm::dvec2 eye = ground.gridFromWorld(glm::dvec2(view.eye)), cell = glm::floor(eye);
    const glm::ivec2 size(ground.width(), ground.height());
    const double tallest = std::max(
        {std::abs(double(ground.minHeight())), std::abs(double(ground.maxHeight())), std::abs(view.eye.z)});
    mFits = view.fall == 0 && double(size.x) * size.y < kMostCells && std::abs(cell.x) < kMostCells &&
            std::abs(cell.y) < kMostCells && tallest < kMostLines * interval * scale;
    if (!mFits) return;
    mRow.shape = shapeOfLines();
    mRow.width = view.width;
    setFloats(mRow.right, view.right * view.pixelWidth());
    setFloats(mRow.up, view.up * view.pixelHeight());
    mRow.heights = ground.data();
    mRow.groundWidth = size.x, mRow.groundHeight = size.y;
    for (int k = 0; k < 2; ++k) {
        mRow.cell[k] = static_cast<int>(cell[k]);
        mRow.place[k] = static_cast<float>(eye[k] - cell[k]);
        mRow.low[k] = static_cast<float>(-kEdgeRoom - cell[k]);
        mRow.high[k] = static_cast<float>(size[k] - 1 + kEdgeRoom - cell[k]);
        mRow.inverseSpacing[k] = static_cast<float>(1 / ground.spacing()[k]);
    }
    mRow.sameCell = static_cast<float>(GroundView::kSameCell);
    mRow.eyeHeight = view.eye.z;
    mRow.interval = static_cast<float>(interval), mRow.perMetre = static_cast<float>(1 / scale);
    mRow.indexStep = indexInterval * scale;
    const double over = view.eye.z / scale;
    mRow.eyeOver = static_cast<float>(over - std::round(over / indexInterval) * indexInterval);
}

void ContourRows::paint(EyeImage& image, int y) const {
    thread_local std::vector<float> numbers;
    thread_local std::vector<std::int32_t> pixels;
    const std::size_t size = static_cast<std::size_t>(image.width()) + ContourRow::kPadding;
    if (pixels.size() < size) pixels.resize(size), numbers.resize(3 * size);
    ContourRow row = mRow;
    setFloats(row.ray, mView.rayDirection(0.5, y + 0.5));
    row.depth = image.viewDepth.row(y);
    row.above = y > 0 ? image.viewDepth.row(y - 1) : nullptr;
    row.below = y + 1 < image.height() ? image.viewDepth.row(y + 1) : nullptr;
    row.color = image.color.row(y);
    row.pixels = pixels.data();
    row.least = numbers.data(), row.share = row.least + size, row.seen = row.share + size;
    const int count = mKernels.find(row);
    if (count == 0) return;
    mKernels.share(row, count);
    if (mFog.any())
        inkThroughFog(row, count, y);
    else
        mKernels.ink(row, count);
    for (int k = 0; k < count; ++k)
        if (row.seen[k] < 0) inkPlainly(row, row.pixels[k], y);
}

// Where a warped eye's ray has to be followed to another cell of the ground.
void ContourRows::inkPlainly(const ContourRow& row, int x, int y) const {
    GroundSeen seen;
    if (!mGround.at(x, y, row.depth[x], seen)) return;
    const double share = contourShareAt(seen, static_cast<double>(row.least[x]), mSetting);
    if (!(share > 0)) return;
    const glm::vec3 ink = mFog.seen(glm::vec3(kContourInk[0], kContourInk[1], kContourInk[2]), mView.eye,
                                    seen.direction, seen.depth);
    row.color[x] = packColor(glm::mix(unpackColor(row.color[x]), ink, static_cast<float>(share)));
}

void ContourRows::inkThroughFog(const ContourRow& row, int pixels, int y) const {
    for (int k = 0; k < pixels; ++k) {
        if (!(row.share[k] > 0)) continue;
        const glm::vec3 ink = mFog.seen(glm::vec3(kContourInk[0], kContourInk[1], kContourInk[2]), mView.eye,
                                        mView.rayDirection(row.pixels[k] + 0.5, y + 0.5), row.seen[k]);
        PackedColor& color = row.color[row.pixels[k]];
        color = packColor(glm::mix(unpackColor(color), ink, row.share[k]));
    }
}

}  // namespace stereonav
