#include "app/view/slice_picture.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kMarkRadius = 7;      // pixels
constexpr double kMarkSlices = 12;  // marks further away are not shown
constexpr double kDim = 0.35;       // of a mark in another slice
constexpr PackedColor kOutline = 1023u | 560u << 10 | 200u << 20;

PackedColor greyOf(double share) {
    // Windows are linear on the display: sRGB bytes, as radiology's viewers show them.
    const double byte = std::clamp(share, 0.0, 1.0) * 255 + 0.5;
    const PackedColor channel = packedFromSrgbByte()[static_cast<std::size_t>(byte)];
    return channel | channel << 10 | channel << 20;
}

PackedColor dimmed(PackedColor c, double share) {
    return packColor(unpackColor(c) * static_cast<float>(share));
}

// Bilinear in the slice; along the cut axis the voxel is whole.
double valueAt(const GreyVolume& grey, const glm::dvec3& voxel, int normal) {
    const int a = (normal + 1) % 3, b = (normal + 2) % 3;
    glm::ivec3 low(glm::floor(voxel));
    low[normal] = static_cast<int>(std::lround(voxel[normal]));
    const glm::ivec3 last = grey.frame.size - 1;
    const double fa = voxel[a] - low[a], fb = voxel[b] - low[b];
    const auto at = [&](int da, int db) {
        glm::ivec3 v = low;
        v[a] += da;
        v[b] += db;
        return static_cast<double>(grey.at(glm::clamp(v, glm::ivec3(0), last)));
    };
    const double near = at(0, 0) * (1 - fa) + at(1, 0) * fa;
    const double far = at(0, 1) * (1 - fa) + at(1, 1) * fa;
    return (near * (1 - fb) + far * fb) * grey.scale + grey.offset;
}

bool insideOf(const MaskVolume& mask, const glm::dvec3& world) {
    const glm::ivec3 v(glm::round(mask.frame.voxelFromWorld(world)));
    return mask.frame.contains(v) && mask.at(v) != 0;
}

// Where the lumen changes between a pixel and the one to its right or below.
void outline(const SliceContent& content, const SliceLayout& layout, int slice, Plane<PackedColor>& picture) {
    const VolumeFrame& frame = content.grey->frame;
    Plane<std::uint8_t> inside(picture.width() + 1, picture.height() + 1);
    parallelFor(inside.height(), [&](int y) {
        for (int x = 0; x < inside.width(); ++x)
            inside.at(x, y) =
                insideOf(*content.lumen, frame.worldFromVoxel(layout.voxelAt(x + 0.5, y + 0.5, slice)));
    });
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (inside.at(x, y) != inside.at(x + 1, y) || inside.at(x, y) != inside.at(x, y + 1))
                picture.at(x, y) = kOutline;
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
    // World axes along the picture: right, down, into it; the sign of down turns the head up.
    struct Axes {
        int across, down, normal;
        double downSign;
    };
    constexpr Axes kAxes[3] = {{0, 1, 2, 1}, {0, 2, 1, -1}, {1, 2, 0, -1}};
    const Axes& world = kAxes[static_cast<int>(axis)];
    // Each world axis gets a voxel axis of its own: the best for the cut one first.
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
    // The place's way from the study's middle, in pixels of the larger picture; the study's border goes no
    // further in than it is in the fitted one.
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
    const double lowest = content.windowLevel - content.windowWidth / 2;
    Plane<PackedColor> picture(width, height);
    parallelFor(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 voxel = layout.voxelAt(x + 0.5, y + 0.5, slice);
            if (layout.worldAt(x + 0.5, y + 0.5, slice))
                picture.at(x, y) =
                    greyOf((valueAt(grey, voxel, layout.normal()) - lowest) / content.windowWidth);
        }
    });
    if (content.lumen && !content.lumen->empty()) outline(content, layout, slice, picture);
    for (const SliceMark& mark : content.marks) {
        const glm::dvec3 voxel = grey.frame.voxelFromWorld(mark.world);
        drawMark(mark, voxel[layout.normal()] - slice, layout.pixelOf(voxel), picture);
    }
    return picture;
}

}  // namespace stereonav
