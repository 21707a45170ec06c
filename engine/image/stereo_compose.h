// One picture from two eyes, for any display: either eye alone, side by side, top-bottom, interleaved,
// anaglyph. Runs on the CPU, for files and video; the window's fragment shader follows the same tables
// (engine/display/stereo_presenter). Modes that show the eyes one after the other exist only in windows
// (engine/display/eye_passes.h).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Modes in the order in which a viewer steps through them.
enum class OutputMode {
    Left,
    Right,
    SideBySide,      // left eye on the left: parallel viewing, most displays
    CrossEyed,       // right eye on the left
    SideBySideHalf,  // each eye squeezed to half its width
    CrossEyedHalf,
    TopBottom,  // left eye on top
    BottomTop,
    TopBottomHalf,  // each eye squeezed to half its height
    BottomTopHalf,
    FramePacked,  // left eye on top, then a gap of 1/24 of its height: HDMI 1.4a
    Rows,         // row 0 from the left eye, row 1 from the right one, ...
    RowsRightFirst,
    Columns,
    ColumnsRightFirst,
    Checkerboard,
    CheckerboardRightFirst,
    RedCyanGray,
    RedCyanHalf,
    RedCyanColor,
    RedCyanDubois,
    GreenMagentaGray,
    GreenMagentaHalf,
    GreenMagentaColor,
    GreenMagentaDubois,
    AmberBlueGray,
    AmberBlueHalf,
    AmberBlueColor,
    AmberBlueDubois,
    RedBlueGray,
    RedGreenGray,
    Alternating,  // left eye at one refresh of the display, right eye at the next
    AlternatingRightFirst,
    QuadBuffer,  // both eyes go to the graphics driver, which shows each to its eye
};

// Where the two eyes lie.
enum class OutputLayout {
    OneEye,
    SideBySide,
    TopBottom,
    FramePacked,
    Rows,
    Columns,
    Checkerboard,
    Anaglyph,
    FrameSequential,  // this one and the next exist only in windows
    QuadBuffer
};

// A mode's names and layout.
struct OutputModeInfo {
    OutputMode mode;
    std::string_view shortName;  // FFmpeg's, "arcd"
    std::string_view longName;   // "red-cyan-dubois"
    OutputLayout layout;
    bool half;        // each eye squeezed along the layout's axis
    bool rightFirst;  // the right eye comes first; where one eye is shown, it is the right one
};

struct ComposeSetting {
    OutputMode mode = OutputMode::SideBySide;
    bool swapEyes = false;  // each eye is shown in the place of the other
    // Anaglyph matrices act on sRGB-encoded values by default, as FFmpeg and most players do (the
    // coefficients of Dubois are mostly quoted for that); true: on linear light, then encoded.
    bool linearAnaglyph = false;

    bool operator==(const ComposeSetting&) const = default;
};

// Weights of sRGB or linear channels, 0 to 1: rows give the output's R, G, B; columns weigh left r, g, b,
// right r, g, b. Clamped to [0, 1] after.
using AnaglyphMatrix = std::array<std::array<float, 6>, 3>;

// All modes, in their order.
std::span<const OutputModeInfo> outputModes();
const OutputModeInfo& infoOf(OutputMode mode);
// Returns whether one picture can hold both eyes in this mode; false for modes that exist only in windows.
bool fitsInPicture(OutputMode mode);
// Returns the mode of FFmpeg's short names (tbl and abl alike) or of the long ones; nullopt for any other.
std::optional<OutputMode> outputModeFromName(std::string_view name);
// Returns all short names, "ml, mr, sbsl, ...", for messages. windows: also those of modes that exist only in
// windows.
std::string outputModeNames(bool windows);

// Returns the weights of an anaglyph mode. Colour: each channel from the eye whose glass passes it. Gray:
// luma .299 .587 .114 of that eye; channels of no glass stay dark. Half-colour: colour, but luma for the eye
// that has one channel only. Dubois: E. Dubois, "A projection method to generate anaglyph stereo images",
// ICASSP 2001, the coefficients published for LCDs.
const AnaglyphMatrix& anaglyphMatrix(OutputMode mode);

// Returns the width and height in pixels of the picture composed from two eyes of width x height. Squeezed
// eyes have half the size, rounded up.
std::pair<int, int> composedSize(OutputMode mode, int width, int height);
// Returns the size of one eye for a picture of at most width x height; at least 1 x 1.
std::pair<int, int> eyeSizeFor(OutputMode mode, int width, int height);

// Share of a frame-packed picture's height that each eye takes: 1080 rows of 2205.
constexpr float kPackedEye = 24.0f / 49.0f;

// A rectangle of pixels, (0, 0) top left.
struct EyeArea {
    int x = 0, y = 0, width = 0, height = 0;

    bool operator==(const EyeArea&) const = default;
};
// Returns where the eye that comes first and the other one lie in a picture of this mode and size; the same
// place twice where they share it. Both are empty where the picture is too small for two.
std::array<EyeArea, 2> eyeAreas(OutputMode mode, int width, int height);

// Composes the picture of two eyes. Squeezed modes average pairs of pixels in linear light; interleaved modes
// take each pixel from one eye, at the same place in it. Throws Error where the two sizes differ or are
// empty, and for modes that do not fit into a picture.
Plane<PackedColor> composeStereo(const Plane<PackedColor>& left, const Plane<PackedColor>& right,
                                 const ComposeSetting& setting);

}  // namespace stereonav
