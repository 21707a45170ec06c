// Registers two studies of one colon along their centrelines: finds for each place of one line the
// anatomically equal place of the other, from length, radius and curvature, with dynamic time warping (Sakoe
// and Chiba, "Dynamic programming algorithm optimization for spoken word recognition", IEEE Trans. ASSP 26
// (1978), with slopes from a half to two). For colons see Nain et al., "Intra-patient prone to supine colon
// registration for synchronized virtual colonoscopy", MICCAI 2002, who compare only radii.
#pragma once

#include <vector>

#include "colon/centreline/centreline.h"

namespace stereonav {

// The mean cost of a pair above which two lines are not of one colon. Measured: see docs/instruments.md.
constexpr double kMostCostOfOneColon = 1;

struct RegistrationSetting {
    double step = 0.003;    // metres between samples of a line, > 0
    double smooth = 0.008;  // metres, > 0: sigma with which radii and places are smoothed first
    double radius = 1;      // weight of a difference of radii by a factor e, each relative to its line's mean
    double direction = 2;   // weight of a difference of unit tangents, in the patient's axes
    double turn = 1;        // weight of a difference of curvatures times 2 cm
    double length = 30;     // weight of a difference of shares of the whole length
};

class LineRegistration {
public:
    // Registers two lines, both from rectum to caecum, with at least two points. Deterministic. Throws Error.
    LineRegistration(const Centreline& first, const Centreline& second,
                     const RegistrationSetting& setting = {});

    // Return the place on the second line, metres from its start, that corresponds to a place on the first,
    // and the reverse. Places beyond an end count as the end. Both are monotonic.
    double toSecond(double along) const { return mapped(mPairs, along, false); }
    double toFirst(double along) const { return mapped(mPairs, along, true); }
    // Returns the mean cost of a matched pair, 0 or more: the lower the more alike; 0 for a line with itself.
    double cost() const { return mCost; }
    // Returns whether both lines can be of one colon.
    bool matches() const { return mCost <= kMostCostOfOneColon; }

private:
    struct Pair {
        double first, second;  // metres along
    };
    static double mapped(const std::vector<Pair>& pairs, double along, bool back);

    std::vector<Pair> mPairs;
    double mCost = 0;  // mean cost of a pair
};

// Returns the place in the world at metres from a line's start, clamped to its ends. The line has at least
// one point.
glm::dvec3 placeAlong(const Centreline& line, double along);

}  // namespace stereonav
