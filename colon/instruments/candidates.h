// Places of a wall that look like polyps, to be looked at by a reader: shape index and curvedness, clustered
// (Yoshida and Naeppi, "Three-dimensional computer-aided diagnosis scheme for detection of colonic polyps",
// IEEE Trans. Med. Imaging 20 (2001); there the clusters are told apart by a classifier that was trained,
// here by their size and by how far they stand out).
#pragma once

#include <vector>

#include "colon/instruments/polyp.h"
#include "engine/base/progress.h"

namespace stereonav {

struct CandidateSetting {
    PolypSetting polyp;
    double shapeIndex = 0.85;                   // the least of a vertex that may be a tip, 0 to 1
    double leastCurved = 40, mostCurved = 800;  // 1/metre: its curvedness
    double leastWide = 0.004, mostWide = 0.04;  // metres: the longest diameter
    double leastScore = 0.0006;                 // metres
};

struct Candidate {
    MeasuredPolyp polyp;
    // MeasuredPolyp::score(), metres.
    double score = 0;
};

// Returns candidates, the highest scores first; of each head one. The result does not depend on the number of
// threads. progress: reports go to it, null for none. Throws Cancelled.
std::vector<Candidate> polypCandidates(const WallMesh& mesh, const WallNeighbours& neighbours,
                                       const CandidateSetting& setting, Progress* progress = nullptr);

}  // namespace stereonav
