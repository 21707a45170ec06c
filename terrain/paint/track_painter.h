// Lines and places of the plan drawn on the ground of a finished eye: where the ground hides them they are
// hidden, without any depth to compare.
//
// A piece of a line is laid on the ground, cut where it crosses cells, and projected. A pixel beside it asks
// the ground that it shows how far, over the plan, the piece is; the tangent plane turns that into pixels.
// Where this agrees with the distance on the screen, the pixel shows the ground that the piece lies on. One
// that shows a hill before it has ground far from it. Marks of places face the eye; they are there where a
// pixel around their middle shows their ground.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/render/eye_painter.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/fog.h"

namespace stereonav {

// Pixels: the line, with what is darker beside it; the mark of a place from its middle to its rim.
constexpr double kTrackWidth = 2.6, kTrackCasing = 4.6, kMarkRadius = 6;
// A blue, linear, that neither ground nor the colours of slopes have.
constexpr float kTrackInk[3] = {0.0f, 0.25f, 1.0f};
constexpr double kCasingShare = 0.65;  // share of black beside the line

class TrackPainter final : public EyePainter {
public:
    // ground and fog must outlive the painter. lines: two places or more each, world metres; closed ones come
    // back by themselves. What lies beside the ground or in its holes is not drawn.
    TrackPainter(const Heightfield& ground, const Fog& fog, const std::vector<std::vector<glm::dvec2>>& lines,
                 const std::vector<glm::dvec2>& places);

    void paint(const EyeView& view, EyeImage& image) const override;

    // Returns the length of all lines, metres over the plan; and that of what lies beside the ground or in
    // its holes.
    double length() const { return mLength; }
    double lengthOutside() const { return mOutside; }

private:
    // Within one cell; a place's mark has both ends at it.
    struct Piece {
        glm::dvec3 from, to;  // world, metres
        double sag = 0;       // metres by which the ground's parabola leaves the chord at most
        bool mark = false;
    };
    void addLine(const glm::dvec2& from, const glm::dvec2& to);
    const Heightfield& mGround;
    const Fog& mFog;
    std::vector<Piece> mPieces;
    double mLength = 0, mOutside = 0;  // metres over the plan
};

}  // namespace stereonav
