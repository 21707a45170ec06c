// The centreline prepared for a flight: by arc length, divided into runs that can be flown without crossing
// tissue, with the room on it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "colon/flight/colon_flight_room.h"

namespace stereonav {

// Part of a centreline on which every point has room for both eyes in any orientation of the head.
struct FlightRun {
    double first = 0, last = 0;  // metres along the line, first < last
};

// Throws Error, naming a number that is not finite or out of range.
void checkColonFlightSetting(const ColonFlightSetting& setting);

class FlightLine {
public:
    // clearance, half: LumenRoom's, metres. Where the line's own free distance is smaller than the clearance
    // needs, the allowed clearance shrinks to kShare of what is left beside the eyes. A run ends where that
    // would be less than kLeast of the clearance, and between segments.
    static constexpr double kShare = 0.8;
    static constexpr double kLeast = 0.2;
    FlightLine(const Centreline& line, const FreeDistance& freeDistance, double clearance, double half);

    // In order; empty: there is nothing to fly along.
    const std::vector<FlightRun>& runs() const { return mRuns; }
    const std::vector<NarrowPlace>& narrow() const { return mNarrow; }

    // Returns the place in the world at s metres along the line, clamped to its ends; defined inside runs.
    glm::dvec3 at(double s) const;
    // Returns the place at s; beyond the run's ends it continues straight.
    glm::dvec3 ahead(const FlightRun& run, double s) const;
    // Returns the unit direction of the run around s, towards the caecum.
    glm::dvec3 direction(const FlightRun& run, double s) const;
    // Returns the radius in metres of a ball around at(s) in which the head has room everywhere, in any
    // orientation. > 0 in runs.
    double roomAt(double s) const { return mPlaces[placeAt(s)].room; }
    // Returns the width of the lumen, metres: the line's own radius. For the view's direction, not for
    // keeping clear of the wall.
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
    std::size_t placeAt(double s) const;  // index of the nearest place
    std::size_t pieceAt(double s) const;  // index of the place before s, never the last one

    double mFarthest;  // metres: free distances are known up to here
    std::vector<Place> mPlaces;
    std::vector<FlightRun> mRuns;
    std::vector<NarrowPlace> mNarrow;
};

}  // namespace stereonav
