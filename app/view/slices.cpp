#include "app/view/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

constexpr PackedColor kSeedColor = 300u | 1000u << 10 | 300u << 20,
                      kEyeColor = 300u | 800u << 10 | 1023u << 20;
constexpr double kEyeMoved = 2e-4;  // metres: less than a voxel is not worth a new picture

struct AxisText {
    const char *name, *letter;
};
constexpr AxisText kAxisTexts[3] = {{"axial", "z"}, {"coronal", "y"}, {"sagittal", "x"}};

}  // namespace

std::string seedText(const glm::dvec3& world) {
    return fmt::format("{:.1f},{:.1f},{:.1f}", 1000 * world.x, 1000 * world.y, 1000 * world.z);
}

SliceView::SliceView(std::shared_ptr<const SliceStudy> study, const glm::dvec3& eye,
                     std::vector<glm::dvec3> seeds)
    : mStudy(std::move(study)), mSlice(layout(1, 1).sliceAt(eye)), mSeeds(std::move(seeds)) {}

void SliceView::nextAxis(const glm::dvec3& eye) {
    mAxis = static_cast<SliceAxis>((static_cast<int>(mAxis) + 1) % 3);
    mSlice = layout(1, 1).sliceAt(mSeeds.empty() ? eye : mSeeds.back());
    mChanged = true;
}

void SliceView::turnPages(int by) {
    const int last = layout(1, 1).sliceCount() - 1;
    const int slice = std::clamp(mSlice + std::clamp(by, -last - 1, last + 1), 0, last);
    mChanged = mChanged || slice != mSlice;
    mSlice = slice;
}

std::string SliceView::click(double x, double y, int width, int height) {
    const SliceLayout slices = layout(width, height);
    const auto world = slices.worldAt(x, y, mSlice);
    if (!world) return "";
    mSeeds.push_back(*world);
    mChanged = true;
    const GreyVolume& grey = mStudy->grey;
    const glm::ivec3 voxel(glm::clamp(glm::round(grey.frame.voxelFromWorld(*world)), glm::dvec3(0),
                                      glm::dvec3(grey.frame.size - 1)));
    return fmt::format("--seed {} (value {:.0f})", seedText(*world),
                       grey.at(voxel) * grey.scale + grey.offset);
}

void SliceView::removeSeed() {
    if (mSeeds.empty()) return;
    mSeeds.pop_back();
    mChanged = true;
}

std::string SliceView::status() const {
    const SliceLayout slices = layout(1, 1);
    const AxisText& axis = kAxisTexts[static_cast<int>(mAxis)];
    return fmt::format(
        "{} slice {} of {}, {} = {:.1f} mm  {} seed{}  click: seed  Backspace: one less  Enter: find the "
        "colon "
        "again  V: next axis  Page Up/Down: slices  Esc: back",
        axis.name, mSlice + 1, slices.sliceCount(), axis.letter, slices.placeOf(mSlice), mSeeds.size(),
        mSeeds.size() == 1 ? "" : "s");
}

const Plane<PackedColor>& SliceView::picture(int width, int height, const glm::dvec3& eye,
                                             const std::shared_ptr<const OpenScene>& scene) {
    const bool moved = glm::length(eye - mDrawnEye) > kEyeMoved;
    if (!mChanged && !moved && mPicture.width() == width && mPicture.height() == height &&
        mDrawnScene == scene)
        return mPicture;
    const SliceSource* const source = scene ? scene->scene->offered<SliceSource>() : nullptr;
    SliceContent content{
        &mStudy->grey, mStudy->windowWidth, mStudy->windowLevel, source ? source->lumen() : nullptr, {}};
    content.marks.push_back({eye, kEyeColor, true});
    for (const glm::dvec3& seed : mSeeds) content.marks.push_back({seed, kSeedColor, false});
    mPicture = drawSlice(content, layout(width, height), mSlice, width, height);
    mDrawnEye = eye;
    mDrawnScene = scene;
    mChanged = false;
    ++mVersion;
    return mPicture;
}

}  // namespace stereonav
