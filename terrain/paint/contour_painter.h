// Contour lines on the ground of a finished eye's picture: equally wide in pixels at any distance, and at the
// same places of the ground in both eyes.
//
// A pixel's distance from a line is the difference between its height and the line's, divided by the change
// of height from pixel to pixel on the cell's tangent plane: exact on planes, and to second order elsewhere.
// Every fifth line is wider. Lines that come closer to each other than a few pixels fade out, the wider ones
// later. Level ground has no lines, whatever its height.
#pragma once

#include "engine/render/eye_painter.h"
#include "engine/simd/simd_target.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/fog.h"

namespace stereonav {

struct ContourSetting {
    double interval = 0;       // metres of the file's heights; 0: no lines
    double verticalScale = 1;  // factor from the file's heights to the ground's
};

// Widths of lines, pixels; distances of lines in pixels at which they have faded out and at which they are
// whole; number of lines from one wide line to the next.
constexpr double kContourWidth = 1.2, kIndexContourWidth = 2.0;
constexpr double kContourGone = 3.5, kContourWhole = 8;
constexpr int kIndexContour = 5;
// Share of ink in the middle of a line, and its linear colour: the brown of maps.
constexpr double kContourShare = 0.75, kIndexContourShare = 0.9;
constexpr float kContourInk[3] = {0.055f, 0.027f, 0.012f};

// Distance in pixels from a line within which it may show; one more than its width needs, since a warped
// eye's depth may be that of the next pixel.
constexpr double kContourReach = 0.5 * kIndexContourWidth + 0.5 + 1;
// Ground counts as level where its height changes by less than this share of an interval from pixel to pixel.
constexpr double kContourLevel = 1e-7;

// Returns a round interval for heights that span `relief` metres: about 25 lines; 0 for level ground.
double contourIntervalFor(double relief);

struct GroundSeen;
// Returns the share of ink, 0 to 1, for ground that a pixel shows; 0 where there is no line. least: half of
// the change of height from pixel to pixel, in metres of the file, on the side where it is smaller; 0 where
// it is unknown.
double contourShareAt(const GroundSeen& seen, double least, const ContourSetting& setting);

class ContourPainter final : public EyePainter {
public:
    // ground and fog must outlive this object; the lines are seen through the fog, like the ground.
    ContourPainter(const Heightfield& ground, const Fog& fog, const ContourSetting& setting,
                   SimdTarget target = SimdTarget::Auto)
        : mGround(ground), mFog(fog), mSetting(setting), mTarget(target) {}

    void paint(const EyeView& view, EyeImage& image) const override;
    // Paints the same pixel by pixel in doubles: the reference for paint(), which also uses it where floats
    // are not exact enough.
    void paintPlainly(const EyeView& view, EyeImage& image) const;

private:
    const Heightfield& mGround;
    const Fog& mFog;
    ContourSetting mSetting;
    SimdTarget mTarget;
};

}  // namespace stereonav
