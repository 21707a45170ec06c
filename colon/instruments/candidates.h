// Finds places of a wall that look like polyps, for a reader to look at: shape index and curvedness,
// clustered (Yoshida and Naeppi, "Three-dimensional computer-aided diagnosis scheme for detection of colonic
// polyps", IEEE Trans. Med. Imaging 20 (2001); there a trained classifier selects the clusters, here their
// size and prominence do).
#pragma once

#include <vector>

#include "colon/instruments/polyp.h"
#include "engine/base/progress.h"

namespace stereonav {

struct CandidateSetting {
    PolypSetting polyp;
    double shapeIndex = 0.85;                   // smallest shape index of a vertex that may be a tip, 0 to 1
    double leastCurved = 40, mostCurved = 800;  // 1/metre: range of its curvedness
    double leastWide = 0.004, mostWide = 0.04;  // metres: range of the longest diameter
    double leastScore = 0.0006;                 // metres: smallest MeasuredPolyp::score()
};

struct Candidate {
    MeasuredPolyp polyp;
    // Result of MeasuredPolyp::score(), metres.
    double score = 0;
};

// Returns candidates, the highest scores first, one for each polyp head. The result does not depend on the
// number of threads. progress: receives reports, may be null. Throws Cancelled.
std::vector<Candidate> polypCandidates(const WallMesh& mesh, const WallNeighbours& neighbours,
                                       const CandidateSetting& setting, Progress* progress = nullptr);

}  // namespace stereonav
