// The centreline as a flight needs it: by arc length, cut into runs that can be flown without crossing
// tissue, with the room that is left on it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "colon/flight/colon_flight_room.h"

namespace stereonav {

// Part of a centreline whose every point has room for both eyes, whatever way the head is turned.
struct FlightRun {
    double first = 0, last = 0;  // metres along the line, first < last
};

// Throws Error, naming the number that is not finite or out of range.
void checkColonFlightSetting(const ColonFlightSetting& setting);

class FlightLine {
public:
    // clearance, half: LumenRoom's, metres. Where the line's own free distance is less than asked for, the
    // clearance allowed shrinks to kShare of what is left beside the eyes; where less than kLeast of the
    // clearance would be left, and between segments, a run ends.
    static constexpr double kShare = 0.8;
    static constexpr double kLeast = 0.2;
    FlightLine(const Centreline& line, const FreeDistance& freeDistance, double clearance, double half);

    const std::vector<FlightRun>& runs() const { return mRuns; }  // in order; empty: nothing to fly along
    const std::vector<NarrowPlace>& narrow() const { return mNarrow; }

    // Returns a place of the line, world. s: metres along the line, clamped to its ends; defined inside runs.
    glm::dvec3 at(double s) const;
    // Returns the place at s, and straight on beyond the run's ends.
    glm::dvec3 ahead(const FlightRun& run, double s) const;
    // Returns the unit direction of the run around s, towards the caecum.
    glm::dvec3 direction(const FlightRun& run, double s) const;
    // Returns the radius of a ball around at(s), metres, that has room everywhere, whatever way the head is
    // turned. > 0 in runs.
    double roomAt(double s) const { return mPlaces[placeAt(s)].room; }
    // Returns how wide the lumen is there, metres: the line's own radius. For looks, not for keeping clear.
    double widthAt(double s) const { return mPlaces[placeAt(s)].width; }
    // Returns the s in [from, to] whose point is nearest to p.
    double nearest(const glm::dvec3& p, double from, double to) const;

private:
    struct Place {
        glm::dvec3 position{0.0};                         // world, metres
        double along = 0, room = 0, free = 0, width = 0;  // metres
        bool endsSegment = false;
    };
    void addPieces(const glm::dvec3& to, double freeThere, const FreeDistance& free, double clearance,
                   double half);
    void measure(std::size_t k, double clearance, double half);
    void findRuns();
    std::size_t placeAt(double s) const;  // the nearest one
    std::size_t pieceAt(double s) const;  // the one before s, not the last

    double mFarthest;  // metres: free distances are known up to here
    std::vector<Place> mPlaces;
    std::vector<FlightRun> mRuns;
    std::vector<NarrowPlace> mNarrow;
};

}  // namespace stereonav
