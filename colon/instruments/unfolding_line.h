// The line along which a wall is unfolded: a smoothed centreline with frames that do not twist, continued
// straight beyond its ends as far as the lumen reaches; and smoothing of values over a wall's vertices.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "colon/centreline/centreline.h"
#include "colon/wall/line_of_sight.h"
#include "colon/wall/wall_mesh.h"

namespace stereonav {

class UnfoldingLine {
public:
    static constexpr double kStep = 0.001;  // metres between frames

    // A frame on the line; tangent, across and over are orthonormal.
    struct Frame {
        glm::dvec3 place{0.0}, tangent{0.0}, across{0.0}, over{0.0};  // world, metres; unit
    };

    // Throws Error for a line shorter than 2 mm.
    UnfoldingLine(const Centreline& line, const LineOfSight& sight);

    double first() const { return -mBefore; }  // metres along the line, <= 0
    double length() const { return mLength; }  // metres, of the centreline
    const std::vector<Frame>& frames() const { return mFrames; }
    // Returns the metres along the line of a frame.
    double alongOf(std::size_t frame) const { return static_cast<double>(frame) * kStep - mBefore; }
    // Returns the frame at metres along the line, interpolated; beyond the ends the last one.
    Frame at(double along) const;

private:
    double mBefore = 0, mLength = 0;  // metres
    std::vector<Frame> mFrames;
};

// Returns the f that minimises the sum of (f - value)^2 over the known vertices and `length`^2 |grad f|^2
// over the wall, for three values at once; length: metres. A screened Poisson equation in linear elements,
// solved by Jacobi's method. Unknown vertices get values from their neighbours. The result does not depend on
// the number of threads.
std::vector<glm::vec3> smoothOverWall(const WallMesh& mesh, const WallNeighbours& neighbours,
                                      std::vector<glm::vec3> values, std::vector<std::uint8_t> known,
                                      double length);

}  // namespace stereonav
