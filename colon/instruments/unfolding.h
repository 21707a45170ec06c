// The wall of a colon laid flat along its centreline.
//
// Every place of the wall goes to one place of the picture: across by the place of the line that it belongs
// to, down by the angle about the line, stretched so that parts of the picture have the area of the wall that
// they show. Casting rays from the line instead (Vilanova Bartroli et al., "Virtual colon flattening", VisSym
// 2001) shows a place twice, or not at all, where sections of a bend cross; here a place has one number along
// the line and one angle, so nothing is shown twice. Both are smoothed over the wall (a screened Poisson
// equation), so that they do not jump where sections cross. Folds that lean over hide what is behind them:
// what is nearer to the line is in front.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "colon/centreline/centreline.h"
#include "colon/instruments/polyp.h"
#include "colon/instruments/unfolding_line.h"
#include "colon/wall/line_of_sight.h"
#include "colon/wall/wall_mesh.h"
#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

struct UnfoldSetting {
    double pixel = 0.0005;  // metres, > 0: side of a pixel on the wall
    double even = 0.005;    // metres, > 0: distance over which areas are equalised
    // Metres, >= 0: distance over which coordinates along and around the line are smoothed.
    double stiff = 0.003;
};

class UnfoldedWall {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;  // no vertex

    // mesh and neighbours must outlive this object. Column 0 is the rectum's end. The result does not depend
    // on the number of threads. Throws Error (no wall, no line, too large a picture), Cancelled.
    UnfoldedWall(const WallMesh& mesh, const WallNeighbours& neighbours, const Centreline& line,
                 const LineOfSight& sight, const UnfoldSetting& setting, Progress& progress);

    int width() const { return mWidth; }  // pixels
    int height() const { return mHeight; }
    double pixel() const { return mSetting.pixel; }  // metres
    // Returns the vertex nearest to the place that a pixel shows; kNone where it shows no wall.
    std::uint32_t vertexAt(int x, int y) const { return mVertex[static_cast<std::size_t>(y) * mWidth + x]; }
    // Returns the place on the wall that a pixel shows: world, metres; empty where it shows none, or outside
    // the picture.
    std::optional<glm::dvec3> placeAt(int x, int y) const;
    // Returns the position of a vertex in the picture, pixels, even where another vertex hides it.
    glm::dvec2 pixelOf(std::uint32_t vertex) const;
    // Returns whether the picture shows other wall there: farther away than `within` metres from the vertex.
    bool hidden(std::uint32_t vertex, double within) const;
    // Returns the share of the wall's area that is hidden in this sense, 0 to 1.
    double hiddenShare(double within) const;

    // Return metres along the line at a column, and the reverse. The line continues straight beyond its ends,
    // where the metres are negative or larger than its length. Columns are evenly spaced along the line,
    // except at its ends, where more wall lies than the columns' height can show.
    double alongAt(double column) const;
    double columnAt(double along) const;

    // Vertices to tint.
    struct Mark {
        std::span<const std::uint32_t> vertices;  // ascending
        glm::vec3 color{1};                       // linear RGB
    };
    // Returns the wall under the lamp of a viewer on the centreline; white where there is no wall. Below it
    // is a mark at every centimetre of the line, a long one at every tenth, and the outline of a square with
    // sides of one centimetre.
    Plane<PackedColor> picture(const VolumeLook& look, std::span<const Mark> marks) const;
    // Returns the enlargement of the wall in the picture, in squares of a centimetre: grey where areas are
    // true, red where they are doubled or more, blue where halved or less.
    Plane<PackedColor> distortionMap() const;

    // Relative errors of the wall's areas in the squares of a centimetre inside the picture.
    struct AreaError {
        double mean = 0, most95 = 0;  // shares, 0: none; most95: 95 of 100 squares have no larger error
        int squares = 0;
    };
    AreaError areaError() const;

    // How a polyp shows: the share of its head's area that is not hidden, 0 to 1; its area in the picture
    // over its true area; and the number of pieces (with at least a tenth of its pixels).
    struct Shown {
        double share = 0, area = 0;
        int pieces = 0;
    };
    Shown shown(const MeasuredPolyp& polyp) const;

private:
    void placeAlong(const LineOfSight& sight, Progress& progress);
    void placeAround(Progress& progress);
    void makeColumns();
    void makeEqual();
    void draw();
    void drawTriangle(const std::array<std::uint32_t, 3>& triangle);
    void drawFlat(const std::array<std::uint32_t, 3>& triangle, const std::array<glm::dvec2, 3>& at);
    double downAt(double column, double turn) const;
    double halfAt(int column) const;
    std::vector<float> densities(int side) const;

    const WallMesh& mMesh;
    const WallNeighbours& mNeighbours;
    UnfoldSetting mSetting;
    UnfoldingLine mLine;
    std::vector<float> mAlong;        // by vertex, metres
    std::vector<float> mTurn, mAway;  // radians; metres from the line
    double mFirst = 0;                // metres along the line at the first column
    std::vector<double> mColumns;     // by step along the line: its column, ascending
    std::vector<float> mTall;         // by column: height of the wall in pixels
    std::vector<float> mShare;        // by column and turn: share of the wall's area up to that turn
    int mWidth = 0, mHeight = 0;
    std::vector<std::uint32_t> mVertex;        // by pixel
    std::vector<float> mNear;                  // by pixel: distance of the shown wall from the line, metres
    std::vector<glm::vec3> mPlaces, mNormals;  // by pixel
};

}  // namespace stereonav
