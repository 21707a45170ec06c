// The wall of a colon laid flat along its centreline.
//
// Every place of the wall goes to one place of the picture: across by the place of the line that it belongs
// to, down by the angle about the line, stretched so that parts of the picture have the area of the wall that
// they show. Casting rays from the line instead (Vilanova Bartroli et al., "Virtual colon flattening", VisSym
// 2001) shows a place twice, or not at all, where sections of a bend cross; here a place has one number along
// the line, smoothed over the wall, so that sections never cross. Folds that lean over hide what is behind
// them: what is nearer to the line is in front.
#pragma once

#include <cstdint>
#include <vector>

#include "colon/centreline/centreline.h"
#include "colon/instruments/polyp.h"
#include "colon/wall/line_of_sight.h"
#include "colon/wall/wall_mesh.h"
#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

struct UnfoldSetting {
    double pixel = 0.0005;  // metres, > 0: of the wall, the side of a pixel
    double smooth = 0.005;  // metres, > 0: over which areas are made equal
    int rounds = 200;       // >= 0: of smoothing the numbers along the line over the wall
};

class UnfoldedWall {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    // All must outlive it. Column 0 is the rectum's end. Throws Error (too large a picture), Cancelled.
    UnfoldedWall(const WallMesh& mesh, const WallNeighbours& neighbours, const Centreline& line,
                 const LineOfSight& sight, const UnfoldSetting& setting, Progress& progress);

    int width() const { return mWidth; }
    int height() const { return mHeight; }
    double pixel() const { return mSetting.pixel; }
    // The vertex that a pixel shows, kNone beside the wall.
    std::uint32_t vertexAt(int x, int y) const { return mVertex[static_cast<std::size_t>(y) * mWidth + x]; }
    // Where a vertex lies in the picture, pixels, also where another one hides it.
    glm::dvec2 pixelOf(std::uint32_t vertex) const;

    // Under the lamp of a viewer on the centreline, white beside the wall, with a scale below: a mark every
    // centimetre of the line, a long one every ten.
    Plane<PackedColor> picture(const VolumeLook& look) const;
    // How much of the picture a piece of wall takes, over squares of a centimetre: grey where it is its area,
    // red twice as much and more, blue half and less.
    Plane<PackedColor> distortionMap() const;

    // Of those squares that lie within the picture: by how much the area of wall in them is off their own.
    struct AreaError {
        double mean = 0, most95 = 0;  // shares; 95 of 100 squares are off by no more
        int squares = 0;
    };
    AreaError areaError() const;

    // How a polyp is shown: the share of its head's area that is not hidden, and in how many pieces (of a
    // twentieth of its pixels at least).
    struct Shown {
        double share = 0;
        int pieces = 0;
    };
    Shown shown(const MeasuredPolyp& polyp) const;

private:
    struct Frame {  // of the line
        glm::dvec3 place, tangent, across, over;
    };
    void makeFrames(const Centreline& line);
    void placeAlong(const LineOfSight& sight, Progress& progress);
    void smoothAlong();
    void placeAround();
    void makeEqual();
    void draw();
    void drawTriangle(const std::array<std::uint32_t, 3>& triangle);
    Frame frameAt(double along) const;
    double downAt(double column, double turn) const;
    double halfAt(int column) const;
    std::vector<float> densities(int side) const;

    const WallMesh& mMesh;
    const WallNeighbours& mNeighbours;
    UnfoldSetting mSetting;
    double mStep = 0.001, mLength = 0;  // of frames; metres
    std::vector<Frame> mFrames;
    std::vector<float> mAlong;        // by vertex, metres
    std::vector<float> mTurn, mAway;  // radians; metres from the line
    std::vector<float> mTall;         // by column: pixels of wall
    std::vector<float> mShare;        // by column and turn: of the wall's area before that turn
    int mWidth = 0, mHeight = 0;
    std::vector<std::uint32_t> mVertex;        // by pixel
    std::vector<float> mNear;                  // by pixel: of what it shows, metres from the line
    std::vector<glm::vec3> mPlaces, mNormals;  // by pixel
};

}  // namespace stereonav
