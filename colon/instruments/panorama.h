// The wall of a colon as seen from both ends of its line: places that a fold hides from one end are visible
// from the other.
//
// An eye moves along the line. At each place it sees a ring of wall, along rays 45 degrees off the line: half
// way between ahead and aside. These rings, side by side, form a strip: as long as the line, as high as a
// turn around it; rays to the same side of the line are in the same row. One strip looks ahead from the
// rectum's end, the other back from the caecum's. A place on a straight wall is in the same column of both.
// Unlike the unfolded wall (unfolding.h) these are views: parts are hidden as they are in flight, areas are
// not preserved, and in bends a place may be seen twice or not at all, as with any rays from a line.
#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "colon/centreline/centreline.h"
#include "colon/instruments/unfolding_line.h"
#include "colon/wall/line_of_sight.h"
#include "colon/wall/wall_mesh.h"
#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/volume/volume_look.h"

namespace stereonav {

class Panorama {
public:
    enum class End { Rectum = 0, Caecum = 1 };  // end of the line that the eye starts from

    // field and sight must outlive this object. pixel: metres along the line, > 0. The result does not depend
    // on the number of threads. Throws Error (no line, too large a picture), Cancelled.
    Panorama(const GreyVolume& field, const Centreline& line, const LineOfSight& sight, double pixel,
             Progress& progress);

    // A place on the wall that picture() shows, and the eye that sees it: world, metres.
    struct Place {
        glm::dvec3 wall{0.0}, eye{0.0};
    };
    // Called from many threads with the place that a pixel of picture() shows.
    using Seen = std::function<void(int x, int y, const Place& place)>;

    int width() const { return mWidth; }
    int height() const { return mHeight; }
    // Returns both strips, the rectum's above, lit by a lamp at the eye; white where there is no eye. Between
    // them is a mark at each centimetre of the line, a longer one at every tenth. seen: called for each pixel
    // that shows wall; may be null. Throws Cancelled.
    Plane<PackedColor> picture(const VolumeLook& look, Progress& progress, const Seen& seen = nullptr) const;

    int rows() const { return 2 * mHeight + kGap; }  // pixels, of picture()
    double pixel() const { return mPixel; }          // metres along the line

    // Returns whether a place (in the lumen; world, metres) lies on a visible ray of some eye.
    bool shows(End from, const glm::dvec3& place) const { return eyeThatSees(from, place).has_value(); }
    // Returns where a place (world, metres) shows in picture(), in continuous pixels: in the strip from the
    // rectum's end, and in the one from the caecum's; empty where it does not show. Of several eyes that see
    // it, the one nearest to the rectum is used.
    std::array<std::optional<glm::dvec2>, 2> pixelsOf(const glm::dvec3& place) const;

    // Shares of the wall's area, 0 to 1, that show from the rectum's end, from the caecum's, and from at
    // least one of them.
    struct Shares {
        double rectum = 0, caecum = 0, either = 0;
    };
    Shares shares(const WallMesh& wall, Progress& progress) const;

private:
    static constexpr int kGap = 14;  // pixels between the strips

    // The ray of a pixel: the frame of its column's eye, and the direction.
    struct Ray {
        UnfoldingLine::Frame from;
        glm::dvec3 way{0.0};  // unit
    };
    std::optional<Ray> rayOf(int x, int y) const;

    double eyeAt(End from, int x) const;                                         // metres along the line
    std::optional<double> eyeThatSees(End from, const glm::dvec3& place) const;  // metres along the line

    const GreyVolume& mField;
    const LineOfSight& mSight;
    UnfoldingLine mLine;
    double mPixel;
    double mRadius = 0;  // metres: mean distance of the wall from the line
    int mWidth = 0, mHeight = 0;
};

}  // namespace stereonav
