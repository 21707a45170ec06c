// Lines and places of a map drawn on the ground of a finished eye's picture; they are hidden where the ground
// hides them, without a comparison of depths.
//
// A piece of a line is laid on the ground, cut where it crosses cells, and projected. For a pixel beside it
// the distance of the pixel's ground from the piece is computed in plan, and converted to pixels by the
// tangent plane. Where this equals the distance on the screen, the pixel shows the ground on which the piece
// lies. A pixel of a hill in front of it has ground far from it. Marks of places face the eye; they are
// visible where a pixel around their middle shows their ground.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/render/eye_painter.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/fog.h"

namespace stereonav {

// Pixels: the line; the line with its dark casing; radius of a place's mark.
constexpr double kTrackWidth = 2.6, kTrackCasing = 4.6, kMarkRadius = 6;
// A linear blue that occurs neither on ground nor among the colours of slopes.
constexpr float kTrackInk[3] = {0.0f, 0.25f, 1.0f};
constexpr double kCasingShare = 0.65;  // share of black in the casing

class TrackPainter final : public EyePainter {
public:
    // ground and fog must outlive this object. lines: at least two places each, world metres; closed ones are
    // closed automatically. Parts outside the ground or in its holes are not drawn.
    TrackPainter(const Heightfield& ground, const Fog& fog, const std::vector<std::vector<glm::dvec2>>& lines,
                 const std::vector<glm::dvec2>& places);

    void paint(const EyeView& view, EyeImage& image) const override;

    // Return the length of all lines in plan, metres, and the length of the parts outside the ground or in
    // its holes.
    double length() const { return mLength; }
    double lengthOutside() const { return mOutside; }

private:
    // A piece within one cell; for a place's mark both ends are equal.
    struct Piece {
        glm::dvec3 from, to;  // world, metres
        double sag = 0;       // metres: largest distance of the ground's parabola from the chord
        bool mark = false;
    };
    void addLine(const glm::dvec2& from, const glm::dvec2& to);
    const Heightfield& mGround;
    const Fog& mFog;
    std::vector<Piece> mPieces;
    double mLength = 0, mOutside = 0;  // metres in plan
};

}  // namespace stereonav
