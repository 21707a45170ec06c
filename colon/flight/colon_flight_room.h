// Where a head with two eyes may be in a lumen: the room left before an eye would be nearer to the wall than
// the clearance. Moves are cut so that nothing in between is passed through. Used by the guided and free
// flight.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "colon/flight/colon_flight.h"

namespace stereonav {

// A place of the centreline where the lumen does not leave the clearance that was asked for.
struct NarrowPlace {
    glm::dvec3 position{0.0};  // world, metres
    double reach = 0;          // metres along the line that this place speaks for, to each side
    double allowed = 0;        // metres: the clearance that is kept here instead
};

class LumenRoom {
public:
    // clearance: metres; half: metres from the head to each eye. Narrow places have an allowed clearance in
    // (0, clearance).
    LumenRoom(FreeDistance freeDistance, double clearance, double half,
              const std::vector<NarrowPlace>& narrow);

    // Metres a metre by which the allowed clearance grows again from narrow places on.
    static constexpr double kAllowedSlope = 0.5;
    // Returns the clearance kept at a world point, metres: what was asked for, less around narrow places.
    double allowed(const glm::dvec3& head) const;

    // Metres a metre by which room() falls at most.
    static constexpr double kSlope = 1 + kAllowedSlope;
    // Returns the metres left before an eye or the head itself is nearer to the wall than allowed, for a head
    // whose right side is `right` (unit); at most upTo; negative: too near.
    double room(const glm::dvec3& head, const glm::dvec3& right, double upTo) const;
    // Returns the unit direction in which the room grows, or 0 where there is no clear one (between two
    // walls).
    glm::dvec3 away(const glm::dvec3& head, const glm::dvec3& right) const;

    // Share of the clearance by which the way of moved() may come nearer to the wall.
    static constexpr double kCrawl = 1.0 / 32;
    // Returns the head moved by `by`, metres, or as far as room is left, sliding along the wall. The new
    // place has room; so does every point on the way, to within kCrawl of the clearance. `head` must have
    // room.
    glm::dvec3 moved(const glm::dvec3& head, const glm::dvec3& right, const glm::dvec3& by) const;
    // Returns whether a head finds room everywhere on the straight way.
    bool wayIsFree(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& right) const;

    // Returns the distance of the nearer eye (or the head) to the wall, metres, at most upTo; and that of a
    // point.
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
    // The last answers and the last ball found free of wall: they save looking again and change no result
    // beyond the tolerance of the distances. Hence one thread. World, metres.
    mutable Answer mLast, mLastFree;
    mutable Direction mLastAway;
    mutable glm::dvec3 mKnownPoint{0.0};                                 // world, metres
    mutable double mKnownFree = 0;                                       // metres
    double mCell = 1;                                                    // metres
    std::unordered_map<std::uint64_t, std::vector<NarrowPlace>> mCells;  // places that matter, by cell
};

}  // namespace stereonav
