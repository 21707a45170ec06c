// Places where a head with two eyes may be in a lumen: how much room is left before an eye would be nearer to
// the wall than the clearance. Moves are shortened so that they pass through no wall. Used by guided and free
// flight.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "colon/flight/colon_flight.h"

namespace stereonav {

// A place of the centreline where the lumen is too narrow for the wished clearance.
struct NarrowPlace {
    glm::dvec3 position{0.0};  // world, metres
    double reach = 0;          // metres along the line to each side for which this holds
    double allowed = 0;        // metres: clearance that is kept here instead
};

class LumenRoom {
public:
    // clearance: metres; half: metres from the head to each eye. Narrow places have an allowed clearance in
    // (0, clearance).
    LumenRoom(FreeDistance freeDistance, double clearance, double half,
              const std::vector<NarrowPlace>& narrow);

    // Slope with which the allowed clearance grows again away from narrow places, metres per metre.
    static constexpr double kAllowedSlope = 0.5;
    // Returns the clearance that is kept at a world point, metres: the wished one, or less around narrow
    // places.
    double allowed(const glm::dvec3& head) const;

    // Largest slope of room(), metres per metre.
    static constexpr double kSlope = 1 + kAllowedSlope;
    // Returns the distance in metres that the head can move in any direction before it or an eye is nearer to
    // the wall than allowed; right: unit, the head's right side; at most upTo; negative: too near already.
    double room(const glm::dvec3& head, const glm::dvec3& right, double upTo) const;
    // Returns the unit direction in which the room grows, or 0 where that is unclear (between two walls).
    glm::dvec3 away(const glm::dvec3& head, const glm::dvec3& right) const;

    // Share of the clearance by which the way of moved() may be nearer to the wall.
    static constexpr double kCrawl = 1.0 / 32;
    // Returns the head moved by `by`, metres, or as far as there is room, sliding along the wall. The new
    // place has room, and so has every point on the way, to within kCrawl of the clearance. `head` must have
    // room.
    glm::dvec3 moved(const glm::dvec3& head, const glm::dvec3& right, const glm::dvec3& by) const;
    // Returns whether a head has room everywhere on the straight line.
    bool wayIsFree(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& right) const;

    // Return the distance in metres from the nearer eye (or the head) to the wall, and from a point to the
    // wall; at most upTo.
    double free(const glm::dvec3& head, const glm::dvec3& right, double upTo) const;
    double freeAt(const glm::dvec3& point, double upTo) const;
    double clearance() const { return mClearance; }  // metres
    double half() const { return mHalf; }            // metres

private:
    struct Answer {
        glm::dvec3 head{0.0}, right{0.0};  // world, metres; unit
        double upTo = -1, room = 0;        // metres
    };
    struct Direction {
        bool known = false;
        glm::dvec3 head{0.0}, right{0.0}, direction{0.0};  // world, metres; unit; unit
    };
    double lookedUp(const glm::dvec3& head, const glm::dvec3& right, double upTo) const;
    std::uint64_t cellOf(const glm::dvec3& p, const glm::ivec3& offset) const;

    FreeDistance mFree;
    double mClearance, mHalf;  // metres
    // The last answers and the last ball found free of wall: they save repeated queries and change results
    // only within the tolerance of the distances. Hence for one thread. World, metres.
    mutable Answer mLast, mLastFree;
    mutable Direction mLastAway;
    mutable glm::dvec3 mKnownPoint{0.0};                                 // world, metres
    mutable double mKnownFree = 0;                                       // metres
    double mCell = 1;                                                    // metres
    std::unordered_map<std::uint64_t, std::vector<NarrowPlace>> mCells;  // places that affect a cell, by cell
};

}  // namespace stereonav
