#include "app/view/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

constexpr PackedColor packed(unsigned red, unsigned green, unsigned blue) {  // linear, 0 to 1023
    return red | green << 10 | blue << 20;
}
// Colours of pieces (taken, left out, left out without certainty) and of marks (taken, left out, the eye).
constexpr PackedColor kTaken = packed(40, 500, 60), kLeft = packed(120, 180, 700),
                      kUnsure = packed(900, 620, 30), kTake = packed(300, 1000, 300),
                      kLeave = packed(1000, 300, 300), kEye = packed(300, 800, 1023);
constexpr double kEyeMoved = 2e-4;  // metres: smaller moves need no new picture

struct AxisText {
    const char *name, *letter;
};
constexpr AxisText kAxisTexts[3] = {{"axial", "z"}, {"coronal", "y"}, {"sagittal", "x"}};

// Returns a place in LPS millimetres, in the form of the command line.
std::string clickedPlace(const glm::dvec3& world) {
    return fmt::format("{:.1f},{:.1f},{:.1f}", 1000 * world.x, 1000 * world.y, 1000 * world.z);
}

bool holds(const MaskVolume& mask, const glm::dvec3& world) {
    const glm::ivec3 voxel(glm::round(mask.frame.voxelFromWorld(world)));
    return mask.frame.contains(voxel) && mask.at(voxel) != 0;
}

}  // namespace

SliceView::SliceView(std::shared_ptr<const SliceStudy> study, const glm::dvec3& eye,
                     const PieceChoices& choices)
    : mStudy(std::move(study)), mSlice(layout(1, 1).sliceAt(eye)) {
    for (const glm::dvec3& place : choices.include) mChoices.push_back({place, true});
    for (const glm::dvec3& place : choices.exclude) mChoices.push_back({place, false});
}

void SliceView::nextAxis(const glm::dvec3& eye) {
    mAxis = static_cast<SliceAxis>((static_cast<int>(mAxis) + 1) % 3);
    mSlice = layout(1, 1).sliceAt(mChoices.empty() ? eye : mChoices.back().place);
    mChanged = true;
}

void SliceView::turnPages(int by) {
    const int last = layout(1, 1).sliceCount() - 1;
    const int slice = std::clamp(mSlice + std::clamp(by, -last - 1, last + 1), 0, last);
    mChanged = mChanged || slice != mSlice;
    mSlice = slice;
}

glm::ivec3 SliceView::voxelAt(const glm::dvec3& world) const {
    const VolumeFrame& frame = mStudy->grey.frame;
    return glm::ivec3(
        glm::clamp(glm::round(frame.voxelFromWorld(world)), glm::dvec3(0), glm::dvec3(frame.size - 1)));
}

std::string SliceView::click(double x, double y, int width, int height, const OpenScene& scene) {
    const auto world = layout(width, height).worldAt(x, y, mSlice);
    if (!world) return "";
    const GreyVolume& grey = mStudy->grey;
    if (mStudy->pieces.list.empty())
        return "this volume is shown without a colon: there are no pieces to choose";
    const double value = grey.at(voxelAt(*world)) * grey.scale + grey.offset;
    const int piece = pieceAt(*world);
    const std::optional<double>& fluidAbove = mStudy->pieces.fluidAbove;
    if (piece < 0 && !(fluidAbove && value > *fluidAbove))
        return fmt::format("value {:.0f} at {}: click in gas or tagged fluid to take or leave it", value,
                           clickedPlace(*world));
    const std::string& text = piece < 0 ? "" : mStudy->pieces.list[static_cast<std::size_t>(piece)].text;
    const std::string what = piece < 0      ? fmt::format("tagged fluid (value {:.0f})", value)
                             : text.empty() ? "this gas"
                                            : text;
    mChanged = true;
    if (piece >= 0 &&
        std::erase_if(mChoices, [&](const Choice& choice) { return pieceAt(choice.place) == piece; }) > 0)
        return "as it was found: " + what;
    const SliceSource* const source = scene.scene->offered<SliceSource>();
    const bool taken = source && source->lumen() && holds(*source->lumen(), *world);
    mChoices.push_back({*world, !taken});
    return fmt::format("{} {} {} {}; Enter finds the colon again", taken ? "--exclude" : "--include",
                       clickedPlace(*world), taken ? "leaves out" : "takes", what);
}

void SliceView::removeChoice() {
    if (mChoices.empty()) return;
    mChoices.pop_back();
    mChanged = true;
}

PieceChoices SliceView::choices() const {
    PieceChoices choices;
    for (const Choice& choice : mChoices)
        (choice.taken ? choices.include : choices.exclude).push_back(choice.place);
    return choices;
}

std::vector<PackedColor> SliceView::tints(const MaskVolume* lumen) const {
    const auto& list = mStudy->pieces.list;
    std::vector<PackedColor> tints(list.size(), 0);
    for (std::size_t n = 0; n < list.size(); ++n) {
        if (list[n].text.empty()) continue;
        const bool taken = lumen && holds(*lumen, list[n].place);
        tints[n] = taken ? kTaken : list[n].sure ? kLeft : kUnsure;
    }
    for (const Choice& choice : mChoices)
        if (const int piece = pieceAt(choice.place); piece >= 0)
            tints[static_cast<std::size_t>(piece)] = choice.taken ? kTaken : kLeft;
    return tints;
}

std::string SliceView::status() const {
    const SliceLayout slices = layout(1, 1);
    const AxisText& axis = kAxisTexts[static_cast<int>(mAxis)];
    const std::string choosing =
        mStudy->pieces.list.empty()
            ? ""
            : fmt::format(
                  "{} change{}  click: take or leave a piece  Backspace: one less  Enter: find the colon "
                  "again  ",
                  mChoices.size(), mChoices.size() == 1 ? "" : "s");
    return fmt::format("{} slice {} of {}, {} = {:.1f} mm  {}V: next axis  Page Up/Down: slices  Esc: back",
                       axis.name, mSlice + 1, slices.sliceCount(), axis.letter, slices.placeOf(mSlice),
                       choosing);
}

const Plane<PackedColor>& SliceView::picture(int width, int height, const glm::dvec3& eye,
                                             const std::shared_ptr<const OpenScene>& scene) {
    const bool moved = glm::length(eye - mDrawnEye) > kEyeMoved;
    if (!mChanged && !moved && mPicture.width() == width && mPicture.height() == height &&
        mDrawnScene == scene)
        return mPicture;
    const SliceSource* const source = scene ? scene->scene->offered<SliceSource>() : nullptr;
    SliceContent content;
    content.grey = &mStudy->grey;
    content.windowWidth = mStudy->windowWidth;
    content.windowLevel = mStudy->windowLevel;
    content.lumen = source ? source->lumen() : nullptr;
    content.pieces = &mStudy->pieces;
    content.tints = tints(content.lumen);
    content.marks.push_back({eye, kEye, true});
    if (source)
        for (const glm::dvec3& seed : source->seeds()) content.marks.push_back({seed, kTake, false});
    for (const Choice& choice : mChoices)
        content.marks.push_back({choice.place, choice.taken ? kTake : kLeave, false});
    mPicture = drawSlice(content, layout(width, height), mSlice, width, height);
    mDrawnEye = eye;
    mDrawnScene = scene;
    mChanged = false;
    ++mVersion;
    return mPicture;
}

}  // namespace stereonav
