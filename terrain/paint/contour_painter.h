// Contour lines on the ground of a finished eye: as wide in pixels at any distance, in both eyes at the same
// places of the ground.
//
// A pixel's distance from a line is the difference of its height from the line's, over the change of height
// from pixel to pixel on the cell's tangent plane: exact on planes, and to the second order elsewhere. Every
// fifth line is wider. Lines that come closer than a few pixels fade, the wider ones later, until nothing is
// left. Level ground has no lines, whatever its height.
#pragma once

#include "engine/render/eye_painter.h"
#include "engine/simd/simd_target.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/fog.h"

namespace stereonav {

struct ContourSetting {
    double interval = 0;       // metres of the file's heights; 0: no lines
    double verticalScale = 1;  // the ground's heights for one of the file's
};

// Widths of lines, pixels; pixels between lines where they are gone and where they are whole; lines from one
// wide line to the next.
constexpr double kContourWidth = 1.2, kIndexContourWidth = 2.0;
constexpr double kContourGone = 3.5, kContourWhole = 8;
constexpr int kIndexContour = 5;
// The share of ink in the middle of a line, and its colour, linear: the brown of maps.
constexpr double kContourShare = 0.75, kIndexContourShare = 0.9;
constexpr float kContourInk[3] = {0.055f, 0.027f, 0.012f};

// Pixels from a line within which it may show, and one more, as a warped eye's depths may be those of the
// next pixel.
constexpr double kContourReach = 0.5 * kIndexContourWidth + 0.5 + 1;
// Ground whose height changes by less than this share of an interval from pixel to pixel is level.
constexpr double kContourLevel = 1e-7;

// Returns a round interval for heights that span `relief`, metres: some 25 lines; 0 for level ground.
double contourIntervalFor(double relief);

struct GroundSeen;
// Returns the ink's share, 0 to 1, where a pixel shows the ground so; 0 where there is no line. least: half
// of how much heights, in metres of the file, differ from pixel to pixel, by the lesser of both sides; 0
// where that is not known.
double contourShareAt(const GroundSeen& seen, double least, const ContourSetting& setting);

class ContourPainter final : public EyePainter {
public:
    // ground and fog must outlive the painter; the lines are seen through the fog as the ground is.
    ContourPainter(const Heightfield& ground, const Fog& fog, const ContourSetting& setting,
                   SimdTarget target = SimdTarget::Auto)
        : mGround(ground), mFog(fog), mSetting(setting), mTarget(target) {}

    void paint(const EyeView& view, EyeImage& image) const override;
    // Paints the same pixel by pixel in doubles: what paint() is held against, and its way where floats do
    // not do.
    void paintPlainly(const EyeView& view, EyeImage& image) const;

private:
    const Heightfield& mGround;
    const Fog& mFog;
    ContourSetting mSetting;
    SimdTarget mTarget;
};

}  // namespace stereonav
