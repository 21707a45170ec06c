// Composes two eyes into one picture: a table of modes, the anaglyph matrices, and one row function
// for each layout.
#include "engine/image/stereo_compose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

using Picture = Plane<PackedColor>;
using enum OutputLayout;

constexpr std::array<OutputModeInfo, 34> kModes{{
    {OutputMode::Left, "ml", "left", OneEye, false, false},
    {OutputMode::Right, "mr", "right", OneEye, false, true},
    {OutputMode::SideBySide, "sbsl", "side-by-side", SideBySide, false, false},
    {OutputMode::CrossEyed, "sbsr", "cross-eyed", SideBySide, false, true},
    {OutputMode::SideBySideHalf, "sbs2l", "side-by-side-half", SideBySide, true, false},
    {OutputMode::CrossEyedHalf, "sbs2r", "cross-eyed-half", SideBySide, true, true},
    {OutputMode::TopBottom, "tbl", "top-bottom", TopBottom, false, false},
    {OutputMode::BottomTop, "tbr", "bottom-top", TopBottom, false, true},
    {OutputMode::TopBottomHalf, "tb2l", "top-bottom-half", TopBottom, true, false},
    {OutputMode::BottomTopHalf, "tb2r", "bottom-top-half", TopBottom, true, true},
    {OutputMode::FramePacked, "hdmi", "frame-packed", FramePacked, false, false},
    {OutputMode::Rows, "irl", "rows", Rows, false, false},
    {OutputMode::RowsRightFirst, "irr", "rows-right-first", Rows, false, true},
    {OutputMode::Columns, "icl", "columns", Columns, false, false},
    {OutputMode::ColumnsRightFirst, "icr", "columns-right-first", Columns, false, true},
    {OutputMode::Checkerboard, "chl", "checkerboard", Checkerboard, false, false},
    {OutputMode::CheckerboardRightFirst, "chr", "checkerboard-right-first", Checkerboard, false, true},
    {OutputMode::RedCyanGray, "arcg", "red-cyan-gray", Anaglyph, false, false},
    {OutputMode::RedCyanHalf, "arch", "red-cyan-half", Anaglyph, false, false},
    {OutputMode::RedCyanColor, "arcc", "red-cyan-color", Anaglyph, false, false},
    {OutputMode::RedCyanDubois, "arcd", "red-cyan-dubois", Anaglyph, false, false},
    {OutputMode::GreenMagentaGray, "agmg", "green-magenta-gray", Anaglyph, false, false},
    {OutputMode::GreenMagentaHalf, "agmh", "green-magenta-half", Anaglyph, false, false},
    {OutputMode::GreenMagentaColor, "agmc", "green-magenta-color", Anaglyph, false, false},
    {OutputMode::GreenMagentaDubois, "agmd", "green-magenta-dubois", Anaglyph, false, false},
    {OutputMode::AmberBlueGray, "aybg", "amber-blue-gray", Anaglyph, false, false},
    {OutputMode::AmberBlueHalf, "aybh", "amber-blue-half", Anaglyph, false, false},
    {OutputMode::AmberBlueColor, "aybc", "amber-blue-color", Anaglyph, false, false},
    {OutputMode::AmberBlueDubois, "aybd", "amber-blue-dubois", Anaglyph, false, false},
    {OutputMode::RedBlueGray, "arbg", "red-blue-gray", Anaglyph, false, false},
    {OutputMode::RedGreenGray, "argg", "red-green-gray", Anaglyph, false, false},
    {OutputMode::Alternating, "al", "alternating", FrameSequential, false, false},
    {OutputMode::AlternatingRightFirst, "ar", "alternating-right-first", FrameSequential, false, true},
    {OutputMode::QuadBuffer, "quad", "quad-buffer", OutputLayout::QuadBuffer, false, false},
}};

constexpr float kR = 0.299f, kG = 0.587f, kB = 0.114f;  // luma, ITU-R BT.601
constexpr std::array<float, 6> kLeftLuma{kR, kG, kB, 0, 0, 0}, kRightLuma{0, 0, 0, kR, kG, kB};
constexpr std::array<float, 6> kLeftRed{1, 0, 0, 0, 0, 0}, kLeftGreen{0, 1, 0, 0, 0, 0};
constexpr std::array<float, 6> kRightRed{0, 0, 0, 1, 0, 0}, kRightGreen{0, 0, 0, 0, 1, 0};
constexpr std::array<float, 6> kRightBlue{0, 0, 0, 0, 0, 1}, kDark{0, 0, 0, 0, 0, 0};

// In the order of OutputMode, from RedCyanGray on.
constexpr std::array<AnaglyphMatrix, 14> kMatrices{{
    {{kLeftLuma, kRightLuma, kRightLuma}},
    {{kLeftLuma, kRightGreen, kRightBlue}},
    {{kLeftRed, kRightGreen, kRightBlue}},
    {{{.456f, .500f, .176f, -.043f, -.088f, -.002f},
      {-.040f, -.038f, -.016f, .378f, .734f, -.018f},
      {-.015f, -.021f, -.005f, -.072f, -.113f, 1.226f}}},
    {{kRightLuma, kLeftLuma, kRightLuma}},
    {{kRightRed, kLeftLuma, kRightBlue}},
    {{kRightRed, kLeftGreen, kRightBlue}},
    {{{-.062f, -.158f, -.039f, .529f, .705f, .024f},
      {.284f, .668f, .143f, -.016f, -.015f, -.065f},
      {-.015f, -.027f, .021f, .009f, .075f, .937f}}},
    {{kLeftLuma, kLeftLuma, kRightLuma}},
    {{kLeftRed, kLeftGreen, kRightLuma}},
    {{kLeftRed, kLeftGreen, kRightBlue}},
    {{{1.062f, -.205f, .299f, -.016f, -.123f, -.017f},
      {-.026f, .908f, .068f, .006f, .062f, -.017f},
      {-.038f, -.173f, .022f, .094f, .185f, .911f}}},
    {{kLeftLuma, kDark, kRightLuma}},
    {{kLeftLuma, kRightLuma, kDark}},
}};

// Rows between the eyes of a frame-packed picture: 45 of 1080, 30 of 720.
constexpr int kEyeRowsAGapRow = 24;
int gapBelow(int eyeHeight) {
    return eyeHeight / kEyeRowsAGapRow;
}
int packedHeight(int eyeHeight) {
    return 2 * eyeHeight + gapBelow(eyeHeight);
}
// Returns the rows of the largest eye that is packed into a picture of `height` rows.
int packedEyeHeight(int height) {
    const long long rows = std::max(height, 0);
    int eye = static_cast<int>(rows * kEyeRowsAGapRow / (2 * kEyeRowsAGapRow + 1));  // a row too few at most
    while (packedHeight(eye + 1) <= height) ++eye;
    return eye;
}

PackedColor average(PackedColor a, PackedColor b) {
    return packColor((unpackColor(a) + unpackColor(b)) * 0.5f);
}

// sRGB-encoded values of the 1024 packed channel values.
const std::array<float, 1024>& encodedFromPacked() {
    static const auto table = [] {
        std::array<float, 1024> t{};
        for (int i = 0; i < 1024; ++i) {
            const float root = static_cast<float>(i) / 1023.0f;
            t[i] = srgbFromLinear(root * root);
        }
        return t;
    }();
    return table;
}

// The packed channel of an encoded value: so fine that its error is below 1/60 of an 8-bit step.
constexpr int kEncodedSteps = 8192;
std::uint32_t packedFromEncoded(float encoded) {
    static const auto table = [] {
        std::vector<std::uint16_t> t(kEncodedSteps + 1);
        for (int i = 0; i <= kEncodedSteps; ++i)
            t[i] = static_cast<std::uint16_t>(
                std::sqrt(linearFromSrgb(static_cast<float>(i) / kEncodedSteps)) * 1023.0f + 0.5f);
        return t;
    }();
    return table[static_cast<int>(std::clamp(encoded, 0.0f, 1.0f) * kEncodedSteps + 0.5f)];
}

std::array<float, 3> apply(const AnaglyphMatrix& m, const std::array<float, 6>& v) {
    std::array<float, 3> out{};
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 6; ++k) out[c] += m[c][k] * v[k];
    return out;
}

PackedColor anaglyphEncoded(const AnaglyphMatrix& m, PackedColor left, PackedColor right) {
    const auto& t = encodedFromPacked();
    const auto c = apply(m, {t[left & 1023u], t[left >> 10 & 1023u], t[left >> 20 & 1023u], t[right & 1023u],
                             t[right >> 10 & 1023u], t[right >> 20 & 1023u]});
    return packedFromEncoded(c[0]) | packedFromEncoded(c[1]) << 10 | packedFromEncoded(c[2]) << 20;
}

PackedColor anaglyphLinear(const AnaglyphMatrix& m, PackedColor left, PackedColor right) {
    const glm::vec3 a = unpackColor(left), b = unpackColor(right);
    const auto c = apply(m, {a.x, a.y, a.z, b.x, b.y, b.z});
    return packColor({c[0], c[1], c[2]});
}

void copyRow(const Picture& eye, int y, PackedColor* out) {
    std::copy_n(eye.row(y), eye.width(), out);
}

void squeezeRow(const Picture& eye, int y, PackedColor* out) {
    const PackedColor* in = eye.row(y);
    const std::ptrdiff_t last = eye.width() - 1;
    for (std::ptrdiff_t x = 0; 2 * x <= last; ++x) out[x] = average(in[2 * x], in[std::min(2 * x + 1, last)]);
}

// One row of the result, from the eye that comes first and the other one.
void sideBySideRow(const Picture& first, const Picture& second, bool half, int y, Picture& out) {
    PackedColor* left = out.row(y);
    PackedColor* right = left + out.width() / 2;
    half ? squeezeRow(first, y, left) : copyRow(first, y, left);
    half ? squeezeRow(second, y, right) : copyRow(second, y, right);
}

void topBottomRow(const Picture& first, const Picture& second, bool half, int y, Picture& out) {
    const int perEye = out.height() / 2;
    const Picture& eye = y < perEye ? first : second;
    const int row = y < perEye ? y : y - perEye;
    if (!half) return copyRow(eye, row, out.row(y));
    const PackedColor* a = eye.row(2 * row);
    const PackedColor* b = eye.row(std::min(2 * row + 1, eye.height() - 1));
    for (int x = 0; x < eye.width(); ++x) out.at(x, y) = average(a[x], b[x]);
}

void framePackedRow(const Picture& first, const Picture& second, int y, Picture& out) {
    const int below = y - first.height() - gapBelow(first.height());
    if (y < first.height()) return copyRow(first, y, out.row(y));
    if (below >= 0) return copyRow(second, below, out.row(y));
    std::fill_n(out.row(y), out.width(), PackedColor{0});
}

void interleaveRow(const Picture& first, const Picture& second, OutputLayout layout, int y, Picture& out) {
    for (int x = 0; x < out.width(); ++x) {
        const int turn = layout == Rows ? y : layout == Columns ? x : x + y;
        out.at(x, y) = turn % 2 == 0 ? first.at(x, y) : second.at(x, y);
    }
}

void anaglyphRow(const Picture& left, const Picture& right, const ComposeSetting& setting, int y,
                 Picture& out) {
    const AnaglyphMatrix& m = anaglyphMatrix(setting.mode);
    const auto mix = setting.linearAnaglyph ? anaglyphLinear : anaglyphEncoded;
    for (int x = 0; x < out.width(); ++x) out.at(x, y) = mix(m, left.at(x, y), right.at(x, y));
}

void composeRow(const Picture& first, const Picture& second, const ComposeSetting& setting, int y,
                Picture& out) {
    const OutputModeInfo& info = infoOf(setting.mode);
    switch (info.layout) {
        case OneEye:
            return copyRow(first, y, out.row(y));
        case SideBySide:
            return sideBySideRow(first, second, info.half, y, out);
        case TopBottom:
            return topBottomRow(first, second, info.half, y, out);
        case FramePacked:
            return framePackedRow(first, second, y, out);
        case Anaglyph:
            return anaglyphRow(first, second, setting, y, out);
        case Rows:
        case Columns:
        case Checkerboard:
            return interleaveRow(first, second, info.layout, y, out);
        case FrameSequential:
        case OutputLayout::QuadBuffer:
            break;  // refused before
    }
}

}  // namespace

std::span<const OutputModeInfo> outputModes() {
    return kModes;
}

const OutputModeInfo& infoOf(OutputMode mode) {
    return kModes[static_cast<std::size_t>(mode)];
}

bool fitsInPicture(OutputMode mode) {
    const OutputLayout layout = infoOf(mode).layout;
    return layout != FrameSequential && layout != OutputLayout::QuadBuffer;
}

std::optional<OutputMode> outputModeFromName(std::string_view name) {
    std::string wanted(name);
    if (wanted.starts_with("ab")) wanted.replace(0, 2, "tb");  // above-below: FFmpeg has both
    if (wanted == "anaglyph") return OutputMode::RedCyanDubois;
    for (const OutputModeInfo& info : kModes)
        if (info.shortName == wanted || info.longName == wanted) return info.mode;
    return std::nullopt;
}

std::string outputModeNames(bool windows) {
    std::string names;
    for (const OutputModeInfo& info : kModes)
        if (windows || fitsInPicture(info.mode))
            names += (names.empty() ? "" : ", ") + std::string(info.shortName);
    return names;
}

const AnaglyphMatrix& anaglyphMatrix(OutputMode mode) {
    if (infoOf(mode).layout != Anaglyph) return kMatrices.front();
    return kMatrices[static_cast<std::size_t>(mode) - static_cast<std::size_t>(OutputMode::RedCyanGray)];
}

std::pair<int, int> composedSize(OutputMode mode, int width, int height) {
    const OutputModeInfo& info = infoOf(mode);
    const auto both = [&](int size) { return info.half ? (size + 1) / 2 * 2 : size * 2; };
    if (info.layout == SideBySide) return {both(width), height};
    if (info.layout == TopBottom) return {width, both(height)};
    if (info.layout == FramePacked) return {width, packedHeight(height)};
    return {width, height};
}

std::pair<int, int> eyeSizeFor(OutputMode mode, int width, int height) {
    const OutputModeInfo& info = infoOf(mode);
    const auto one = [&](int size) { return info.half ? size / 2 * 2 : size / 2; };
    if (info.layout == SideBySide) width = one(width);
    if (info.layout == TopBottom) height = one(height);
    if (info.layout == FramePacked) height = packedEyeHeight(height);
    return {std::max(width, 1), std::max(height, 1)};
}

std::array<EyeArea, 2> eyeAreas(OutputMode mode, int width, int height) {
    width = std::max(width, 0);
    height = std::max(height, 0);
    const EyeArea all{0, 0, width, height};
    switch (infoOf(mode).layout) {
        case SideBySide:
            return {EyeArea{0, 0, width / 2, height}, {width / 2, 0, width / 2, height}};
        case TopBottom:
            return {EyeArea{0, 0, width, height / 2}, {0, height / 2, width, height / 2}};
        case FramePacked: {
            const int eye = packedEyeHeight(height);
            return {EyeArea{0, 0, width, eye}, {0, eye + gapBelow(eye), width, eye}};
        }
        default:
            return {all, all};
    }
}

Picture composeStereo(const Picture& left, const Picture& right, const ComposeSetting& setting) {
    if (left.empty() || left.width() != right.width() || left.height() != right.height())
        throw Error("", "stereo picture",
                    fmt::format("expected two eyes of one size, got {}x{} and {}x{}", left.width(),
                                left.height(), right.width(), right.height()),
                    "render both eyes at the same size");
    if (!fitsInPicture(setting.mode))
        throw Error("", "stereo picture",
                    fmt::format("{} is a mode of windows: it shows one eye after the other",
                                infoOf(setting.mode).shortName),
                    "take sbsl, which keeps both");
    const auto [width, height] = composedSize(setting.mode, left.width(), left.height());
    Picture out(width, height);
    const bool swapped = setting.swapEyes != infoOf(setting.mode).rightFirst;
    const Picture& first = swapped ? right : left;
    const Picture& second = swapped ? left : right;
    parallelFor(height, [&](int y) { composeRow(first, second, setting, y, out); });
    return out;
}

}  // namespace stereonav
