// Two studies of one colon, registered along their centrelines: to each place of one line the place of the
// other that is the same anatomy. By length, radius, and how the line turns, with dynamic time warping (Sakoe
// and Chiba, "Dynamic programming algorithm optimization for spoken word recognition", IEEE Trans. ASSP 26
// (1978), with slopes from a half to two); for colons as Nain et al., "Intra-patient prone to supine colon
// registration for synchronized virtual colonoscopy", MICCAI 2002, who compare radii alone.
#pragma once

#include <vector>

#include "colon/centreline/centreline.h"

namespace stereonav {

// The mean cost of a pair above which two lines are not of one colon. Measured: see docs/instruments.md.
constexpr double kMostCostOfOneColon = 1;

struct RegistrationSetting {
    double step = 0.003;    // metres between samples of a line, > 0
    double smooth = 0.008;  // metres, sigma over which radii and places are smoothed first, > 0
    double radius = 1;      // weight of a difference of radii by a factor e, each by its line's own mean
    double direction = 2;   // weight of a difference of unit tangents, in the patient's axes
    double turn = 1;        // weight of a difference of curvatures times 2 cm
    double length = 30;     // weight of a difference of shares of the whole length
};

class LineRegistration {
public:
    // Registers two lines, both from rectum to caecum, of two points at least. The same for the same lines.
    // Throws Error.
    LineRegistration(const Centreline& first, const Centreline& second,
                     const RegistrationSetting& setting = {});

    // Returns the place of the second line, metres from its start, that belongs to this one of the first; and
    // back. What is beyond an end counts as the end. Neither ever goes back where its argument goes on.
    double toSecond(double along) const { return mapped(mPairs, along, false); }
    double toFirst(double along) const { return mapped(mPairs, along, true); }
    // Returns the mean cost of a matched pair, 0 or more: lower is more alike; 0 of a line with itself.
    double cost() const { return mCost; }
    // Returns whether both lines may lead through one colon.
    bool matches() const { return mCost <= kMostCostOfOneColon; }

private:
    struct Pair {
        double first, second;  // metres along
    };
    static double mapped(const std::vector<Pair>& pairs, double along, bool back);

    std::vector<Pair> mPairs;
    double mCost = 0;  // mean cost of a pair
};

// Returns a place of a line, world, by metres from its start; its ends beyond them. The line has one point or
// more.
glm::dvec3 placeAlong(const Centreline& line, double along);

}  // namespace stereonav
