// Motion of a head about a pivot, for hands that turn an object: the head turns round the pivot, moves
// sideways with it, and comes nearer to it. Heads keep their roll, so that none builds up.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/camera/pose.h"

namespace stereonav {

class PivotMotion {
public:
    // Distances from the pivot that zooming keeps to, metres, 0 < nearest <= farthest < infinity. A head that
    // is nearer or farther away may only move towards them.
    struct Range {
        double nearest = 0, farthest = 0;
    };
    static constexpr double kZoomSeconds = 0.08;  // in which 63 % of a zoom is done

    // Throws Error where the range is none.
    explicit PivotMotion(const Range& range);

    const glm::dvec3& pivot() const { return mPivot; }  // world, metres
    // Sets the pivot, and ends a zoom. Numbers that are not finite change nothing.
    void setPivot(const glm::dvec3& pivot);

    // Returns the head turned by radians, clockwise seen from above and upwards, and moved so that the pivot
    // stays where the head sees it. Upwards ends where the head looks straight up or down.
    Pose turned(const Pose& head, double yaw, double pitch) const;
    // Returns the head moved so that the head sees the pivot moved: by x to the right and y up, in units of
    // the plane at view depth 1. Where the pivot is not ahead, its distance takes its depth's place.
    Pose panned(const Pose& head, const glm::dvec2& by) const;

    // Asks for a distance `factor` as large; several factors are multiplied. Numbers that are not above 0 and
    // finite change nothing.
    void zoomBy(double factor);
    bool zooming() const { return mLeft != 0; }
    void endZoom() { mLeft = 0; }
    // Returns the head dt seconds later on its way to that distance, straight towards the pivot or away from
    // it: the head sees the pivot where it did. dt below 0 or NaN counts as 0.
    Pose zoomed(const Pose& head, double dt);

private:
    Range mRange;
    glm::dvec3 mPivot{0.0};  // world, metres
    double mLeft = 0;        // logarithm of the factor that is still to come
};

}  // namespace stereonav
