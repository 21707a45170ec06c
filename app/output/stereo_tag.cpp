#include "app/output/stereo_tag.h"

namespace stereonav {
namespace {

// Tags of a layout with the left eye first, and with the right eye first.
struct LayoutTag {
    OutputLayout layout;
    StereoTag leftFirst, rightFirst;
};

// The layouts' tags. aspect: squeezed eyes have pixels twice as wide or high, and so have interleaved ones,
// since each has every other column or row. FFmpeg halves Matroska's display size for these layouts (except a
// checkerboard), which is right for whole eyes side by side; the aspect corrects it for the others.
constexpr LayoutTag kLayoutTags[] = {
    {OutputLayout::SideBySide, {1, 2, 3}, {11, -1, -1}},
    {OutputLayout::TopBottom, {3, 1, 4}, {2, -1, -1}},
    {OutputLayout::Rows, {7, -1, 2, 1, 2}, {6, -1, -1, 1, 2}},
    {OutputLayout::Columns, {9, -1, 1, 2, 1}, {8, -1, -1, 2, 1}},
    {OutputLayout::Checkerboard, {5, -1, 0}, {4, -1, -1}},
};
constexpr StereoTag kOneEye{0, 0, -1};
constexpr StereoTag kRedCyan{10, -1, -1}, kGreenMagenta{12, -1, -1};

// Returns the tag of the anaglyphs that Matroska has a value for, the left eye behind the first colour.
StereoTag anaglyphTag(OutputMode mode, bool swapEyes) {
    if (swapEyes) return {};
    if (mode >= OutputMode::RedCyanGray && mode <= OutputMode::RedCyanDubois) return kRedCyan;
    if (mode >= OutputMode::GreenMagentaGray && mode <= OutputMode::GreenMagentaDubois) return kGreenMagenta;
    return {};
}

}  // namespace

StereoTag stereoTagOf(OutputMode mode, bool swapEyes) {
    const OutputModeInfo& info = infoOf(mode);
    if (info.layout == OutputLayout::OneEye) return kOneEye;
    if (info.layout == OutputLayout::Anaglyph) return anaglyphTag(mode, swapEyes);
    for (const LayoutTag& entry : kLayoutTags) {
        if (entry.layout != info.layout) continue;
        StereoTag tag = info.rightFirst != swapEyes ? entry.rightFirst : entry.leftFirst;
        if (info.half) (info.layout == OutputLayout::SideBySide ? tag.aspectWidth : tag.aspectHeight) = 2;
        return tag;
    }
    return {};
}

bool saysStereo(VideoKind kind, OutputMode mode, bool swapEyes) {
    if (infoOf(mode).layout == OutputLayout::OneEye) return true;
    const StereoTag tag = stereoTagOf(mode, swapEyes);
    switch (kind) {
        case VideoKind::Mp4:
            return tag.st3d >= 0 || tag.framePacking >= 0;
        case VideoKind::Mkv:
            return tag.matroska >= 0;
        case VideoKind::Avi:
            break;
    }
    return false;
}

}  // namespace stereonav
