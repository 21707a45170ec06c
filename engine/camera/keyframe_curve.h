// The flight through keyframes. Positions lie on a centripetal Catmull-Rom spline (Yuksel, Schaefer, Keyser,
// "Parameterization and applications of Catmull-Rom curves", 2011: no cusps, no loops). Arc length against
// time is a monotone cubic (Fritsch and Carlson 1980), so that the speed is continuous and the flight never
// goes backwards. Rotations are quaternion Bezier curves (Shoemake, SIGGRAPH 1985) with continuous angular
// speed. The flight stops where successive keyframes have the same position.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// A flight through keyframes, by their times.
class KeyframeCurve {
public:
    // easeEnds: the flight rests at the first and the last keyframe. Throws Error for fewer than two
    // keyframes, and for keyframes that RecordedPath would refuse as samples.
    KeyframeCurve(const std::vector<PathSample>& keyframes, bool easeEnds);

    Pose at(double time) const;                              // seconds, clamped to the ends
    double startTime() const { return mKeys.front().time; }  // seconds
    double endTime() const { return mKeys.back().time; }     // seconds
    double length() const { return mAlong.back(); }          // metres

private:
    // The curve from one keyframe to the next.
    struct Piece {
        glm::dvec3 fromTangent{0.0}, toTangent{0.0};  // metres over the piece's own parameter, 0 to 1
        std::vector<double> lengths;                  // metres from its start, at several parameters
        // Derivative of the parameter by arc length, per metre, at the same parameters.
        std::vector<double> slopes;
    };
    glm::dvec3 place(std::size_t piece, double parameter) const;
    double rate(std::size_t piece, double parameter) const;  // metres per unit of the parameter
    double parameterAt(const Piece& piece, double along) const;
    void findTangents();
    void measure();
    void findSpeeds(bool easeEnds);
    void findSpins(bool easeEnds);

    std::vector<PathSample> mKeys;  // quaternions with signs such that neighbours take the shorter arc
    std::vector<Piece> mPieces;
    std::vector<double> mAlong;     // metres, at keyframes
    std::vector<double> mSpeed;     // metres a second, at keyframes
    std::vector<glm::dvec3> mSpin;  // radians a second about the head's own axes, at keyframes
};

}  // namespace stereonav
