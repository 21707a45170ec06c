#include "app/view/slice_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/ext/vector_int3_sized.hpp>

namespace stereonav {
namespace {

constexpr int kMarkRadius = 7;      // pixels
constexpr double kMarkSlices = 12;  // farther marks are not shown
constexpr double kDim = 0.35;       // opacity of a mark in another slice
constexpr float kTint = 0.5f;       // share of a piece's colour
constexpr PackedColor kOutline = 1023u | 560u << 10 | 200u << 20;

PackedColor greyOf(double share) {
    // The window is linear in sRGB bytes, as in viewers of radiology.
    const double byte = std::clamp(share, 0.0, 1.0) * 255 + 0.5;
    const PackedColor channel = packedFromSrgbByte()[static_cast<std::size_t>(byte)];
    return channel | channel << 10 | channel << 20;
}

PackedColor dimmed(PackedColor c, double share) {
    return packColor(unpackColor(c) * static_cast<float>(share));
}

// Interpolation along one axis of the picture: for each pixel the voxels before and after its middle, as
// steps from the first value, and the weight of the one after.
struct Between {
    std::ptrdiff_t before = 0, behind = 0;
    double share = 0;
    bool within = false;  // whether it is inside the study
};

std::vector<Between> betweenVoxels(int pixels, int size, std::ptrdiff_t step,
                                   const std::function<double(double)>& voxelAt) {
    std::vector<Between> list(static_cast<std::size_t>(pixels));
    for (int n = 0; n < pixels; ++n) {
        const double voxel = voxelAt(n + 0.5);
        Between& here = list[static_cast<std::size_t>(n)];
        here.within = voxel >= -0.5 && voxel <= size - 0.5;
        if (!here.within) continue;
        const double low = std::floor(voxel);
        here.share = voxel - low;
        const int first = static_cast<int>(low);
        here.before = step * std::clamp(first, 0, size - 1);
        here.behind = step * std::clamp(first + 1, 0, size - 1);
    }
    return list;
}

// Draws the lumen's outline, where a pixel and its neighbour to the right or below differ.
void outline(const SliceContent& content, const SliceLayout& layout, int slice, Plane<PackedColor>& picture) {
    const MaskVolume& mask = *content.lumen;
    Plane<std::uint8_t> inside(picture.width() + 1, picture.height() + 1);
    const auto maskVoxelAt = [&](double x, double y) {
        return mask.frame.voxelFromWorld(content.grey->frame.worldFromVoxel(layout.voxelAt(x, y, slice)));
    };
    // Step between voxels of the other frame per pixel, the same everywhere.
    const double w = inside.width(), h = inside.height();
    const glm::dvec3 first = maskVoxelAt(0.5, 0.5), right = (maskVoxelAt(w + 0.5, 0.5) - first) / w,
                     down = (maskVoxelAt(0.5, h + 0.5) - first) / h;
    for (int y = 0; y < inside.height(); ++y)
        for (int x = 0; x < inside.width(); ++x) {
            const glm::ivec3 v(
                glm::round(first + static_cast<double>(x) * right + static_cast<double>(y) * down));
            inside.at(x, y) = mask.frame.contains(v) && mask.at(v) != 0;
        }
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (inside.at(x, y) != inside.at(x + 1, y) || inside.at(x, y) != inside.at(x, y + 1))
                picture.at(x, y) = kOutline;
}

// Blends the colours of pieces over their voxels.
void tint(const SliceContent& content, const SliceLayout& layout, int slice, Plane<PackedColor>& picture) {
    const glm::dvec3 first = layout.voxelAt(0.5, 0.5, slice), right = layout.voxelAt(1.5, 0.5, slice) - first,
                     down = layout.voxelAt(0.5, 1.5, slice) - first;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const int piece = content.pieces->at(glm::ivec3(
                glm::round(first + static_cast<double>(x) * right + static_cast<double>(y) * down)));
            if (piece < 0) continue;
            const PackedColor color = content.tints[static_cast<std::size_t>(piece)];
            if (color == 0) continue;
            const glm::vec3 from = unpackColor(picture.at(x, y));
            picture.at(x, y) = packColor(glm::mix(from, unpackColor(color), kTint));
        }
}

void plot(Plane<PackedColor>& picture, int x, int y, PackedColor color) {
    if (x >= 0 && y >= 0 && x < picture.width() && y < picture.height()) picture.at(x, y) = color;
}

void drawMark(const SliceMark& mark, double slicesAway, const glm::dvec2& at, Plane<PackedColor>& picture) {
    if (!(std::abs(slicesAway) <= kMarkSlices) || !(std::abs(at.x) < 1e6 && std::abs(at.y) < 1e6)) return;
    const PackedColor color = std::abs(slicesAway) <= 0.5 ? mark.color : dimmed(mark.color, kDim);
    const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
    for (int d = -kMarkRadius; d <= kMarkRadius; ++d) {
        if (mark.ring) {
            const int half = static_cast<int>(std::lround(std::sqrt(kMarkRadius * kMarkRadius - d * d)));
            for (const int s : {-half, half}) {
                plot(picture, x + d, y + s, color);
                plot(picture, x + s, y + d, color);
            }
        } else {
            plot(picture, x + d, y, color);
            plot(picture, x, y + d, color);
        }
    }
}

}  // namespace

SliceLayout::SliceLayout(const VolumeFrame& frame, SliceAxis axis, int width, int height)
    : mFrame(frame), mMiddle(width / 2.0, height / 2.0) {
    // World axes of the picture: right, down, into it; the sign of down puts the head at the top.
    struct Axes {
        int across, down, normal;
        double downSign;
    };
    constexpr Axes kAxes[3] = {{0, 1, 2, 1}, {0, 2, 1, -1}, {1, 2, 0, -1}};
    const Axes& world = kAxes[static_cast<int>(axis)];
    // Each world axis gets a voxel axis of its own; the cut axis is assigned first.
    const auto best = [&](int worldAxis, int taken, int takenToo) {
        int found = -1;
        for (int k = 0; k < 3; ++k)
            if (k != taken && k != takenToo &&
                (found < 0 || std::abs(frame.axes[k][worldAxis]) > std::abs(frame.axes[found][worldAxis])))
                found = k;
        return found;
    };
    mPatientAxis = world.normal;
    mNormal = best(world.normal, -1, -1);
    mAcross = best(world.across, mNormal, -1);
    mDown = 3 - mNormal - mAcross;
    mAcrossSign = frame.axes[mAcross][world.across] < 0 ? -1 : 1;
    mDownSign = frame.axes[mDown][world.down] * world.downSign < 0 ? -1 : 1;
    mScale = std::min(width / (frame.size[mAcross] * frame.spacing[mAcross]),
                      height / (frame.size[mDown] * frame.spacing[mDown]));
}

int SliceLayout::sliceAt(const glm::dvec3& world) const {
    const double s = mFrame.voxelFromWorld(world)[mNormal];
    if (std::isnan(s)) return 0;
    return static_cast<int>(std::lround(std::clamp(s, 0.0, sliceCount() - 1.0)));
}

glm::dvec3 SliceLayout::voxelAt(double x, double y, int slice) const {
    glm::dvec3 voxel;
    voxel[mNormal] = slice;
    voxel[mAcross] =
        (mFrame.size[mAcross] - 1) / 2.0 + mAcrossSign * (x - mMiddle.x) / (mScale * mFrame.spacing[mAcross]);
    voxel[mDown] =
        (mFrame.size[mDown] - 1) / 2.0 + mDownSign * (y - mMiddle.y) / (mScale * mFrame.spacing[mDown]);
    return voxel;
}

glm::dvec2 SliceLayout::pixelOf(const glm::dvec3& voxel) const {
    const auto from = [&](int axis) {
        return (voxel[axis] - (mFrame.size[axis] - 1) / 2.0) * mFrame.spacing[axis] * mScale;
    };
    return mMiddle + glm::dvec2(mAcrossSign * from(mAcross), mDownSign * from(mDown));
}

std::optional<glm::dvec3> SliceLayout::worldAt(double x, double y, int slice) const {
    const glm::dvec3 voxel = voxelAt(x, y, slice);
    for (int k = 0; k < 3; ++k)
        if (!(voxel[k] >= -0.5 && voxel[k] <= mFrame.size[k] - 0.5)) return std::nullopt;
    return mFrame.worldFromVoxel(voxel);
}

SliceLayout SliceLayout::zoomed(double factor, const glm::dvec3& world) const {
    SliceLayout larger = *this;
    if (!(factor > 1)) return larger;
    larger.mScale *= factor;
    // Distance of the place from the study's middle, in pixels of the larger picture; the study's border
    // stays at least as far out as in the fitted one.
    const glm::dvec2 away = larger.pixelOf(mFrame.voxelFromWorld(world)) - mMiddle;
    if (std::isnan(away.x) || std::isnan(away.y)) return larger;
    const auto half = [&](int axis) { return mFrame.size[axis] * mFrame.spacing[axis] * larger.mScale / 2; };
    const glm::dvec2 most(std::max(half(mAcross) - mMiddle.x, 0.0), std::max(half(mDown) - mMiddle.y, 0.0));
    larger.mMiddle = mMiddle - glm::clamp(away, -most, most);
    return larger;
}

glm::dvec3 SliceLayout::onSlice(const glm::dvec3& world, int slice) const {
    glm::dvec3 voxel = mFrame.voxelFromWorld(world);
    voxel[mNormal] = slice;
    return mFrame.worldFromVoxel(voxel);
}

double SliceLayout::placeOf(int slice) const {
    glm::dvec3 middle = 0.5 * glm::dvec3(mFrame.size - 1);
    middle[mNormal] = slice;
    return 1000 * mFrame.worldFromVoxel(middle)[mPatientAxis];
}

Plane<PackedColor> drawSlice(const SliceContent& content, const SliceLayout& layout, int slice, int width,
                             int height) {
    const GreyVolume& grey = *content.grey;
    const glm::ivec3& size = grey.frame.size;
    const double lowest = content.windowLevel - content.windowWidth / 2;
    Plane<PackedColor> picture(width, height);
    const int across = layout.across(), down = layout.down(), normal = layout.normal();
    const glm::i64vec3 steps(1, size.x, static_cast<std::int64_t>(size.x) * size.y);
    // Values are bilinear within the slice, and nearest along the cut axis. A pixel's voxel is the sum of a
    // number for its column and one for its row.
    const auto columns = betweenVoxels(width, size[across], steps[across],
                                       [&](double x) { return layout.voxelAt(x, 0, slice)[across]; });
    const auto rows = betweenVoxels(height, size[down], steps[down],
                                    [&](double y) { return layout.voxelAt(0, y, slice)[down]; });
    const std::int16_t* const values =
        grey.values.data() + steps[normal] * std::clamp(slice, 0, size[normal] - 1);
    const bool within = slice >= 0 && slice < size[normal];
    for (int y = 0; within && y < height; ++y) {
        const Between& row = rows[static_cast<std::size_t>(y)];
        if (!row.within) continue;
        const std::int16_t *const upper = values + row.before, *const lower = values + row.behind;
        for (int x = 0; x < width; ++x) {
            const Between& column = columns[static_cast<std::size_t>(x)];
            if (!column.within) continue;
            const double above =
                upper[column.before] * (1 - column.share) + upper[column.behind] * column.share;
            const double below =
                lower[column.before] * (1 - column.share) + lower[column.behind] * column.share;
            const double value = (above * (1 - row.share) + below * row.share) * grey.scale + grey.offset;
            picture.at(x, y) = greyOf((value - lowest) / content.windowWidth);
        }
    }
    if (content.pieces && !content.tints.empty()) tint(content, layout, slice, picture);
    if (content.lumen && !content.lumen->empty()) outline(content, layout, slice, picture);
    for (const SliceMark& mark : content.marks) {
        const glm::dvec3 voxel = grey.frame.voxelFromWorld(mark.world);
        drawMark(mark, voxel[layout.normal()] - slice, layout.pixelOf(voxel), picture);
    }
    return picture;
}

}  // namespace stereonav
