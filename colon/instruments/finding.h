// Findings of a reader: what was measured at a place of a colon, where in the colon it is, and what a list of
// them amounts to. Not a medical device.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "colon/centreline/centreline.h"
#include "colon/instruments/polyp.h"
#include "colon/instruments/polyp_values.h"
#include "colon/instruments/shared_wall.h"
#include "colon/scene/colon_scene.h"

namespace stereonav {

// The most findings that a document keeps: each is measured when it is opened, and compared with the others.
constexpr std::size_t kMostFindings = 1000;

struct Finding {
    glm::dvec3 asked{0.0};  // world, metres: where it was looked for
    std::string comment;
    std::optional<Polyp> truth;  // a generated colon's

    std::optional<MeasuredPolyp> polyp;
    std::string problem;                // why there is none, or a note on it; ""
    double along = 0;                   // metres from the rectum
    std::string segment;                // segment of the colon, by landmarks; "": not told
    std::optional<PolypValues> values;  // the CT's values inside the polyp; none: not told

    bool candidate = false;  // found by the program alone: nobody has looked at it and kept it

    double diameter() const { return polyp ? polyp->widest.length : 0; }  // metres
    bool doubled = false;  // shows the same polyp as one before it in its list
    // Returns whether the diameter is that of the truth, within 1 mm or a tenth. True without a truth.
    bool right() const;
};

class FindingTool {
public:
    // colon must outlive the tool; wall: the wall of it. Values are those of its `study`, where it has one.
    FindingTool(const ColonScene& colon, std::shared_ptr<const JoinedWall> wall);

    // Takes values from this study from now on, which must outlive the tool.
    void useStudy(const GreyVolume& study);

    // Measures what is at a place: world, metres. Where there is no polyp `problem` says so.
    Finding at(const glm::dvec3& place) const;
    // Measures the polyps of a generated colon, at their true places.
    std::vector<Finding> atTruth() const;
    // Finds places that look like polyps (candidates.h), as candidates, with a comment that says so. Throws
    // Cancelled.
    std::vector<Finding> candidates(Progress& progress) const;

    const WallMesh& wall() const { return mWall->mesh; }

private:
    const ColonScene& mColon;
    std::shared_ptr<const JoinedWall> mWall;
    const GreyVolume* mStudy = nullptr;  // null: it has no values
    std::optional<double> mBlur;         // blur of mStudy across the wall, metres
};

// Adds a finding to a list in which the same place is one entry: a place that is there already (within
// kSamePlace) or, where either is a candidate, a polyp that is there already. What a person gives is no
// candidate any more, and has their comment.
void addFinding(std::vector<Finding>& findings, Finding finding);
constexpr double kSamePlace = 0.0005;  // metres
// Returns whether the list has that place already: then it needs no measuring to be added.
bool listsPlace(const std::vector<Finding>& findings, const glm::dvec3& place);

// Notes on findings that show one polyp: each but the first says so. Nothing is left out.
void noteDoubles(std::vector<Finding>& findings);

// Returns where a place of the line, metres from its start, lies: "rectum", "sigmoid", "descending", "splenic
// flexure", "transverse", "hepatic flexure", "ascending", "caecum"; "" where the line has no two flexures. By
// landmarks alone: the flexures are the highest places on the left and, after it, on the right; the
// descending colon reaches down to where the line rises again; the rectum is the first 15 cm, the caecum the
// last 6 cm.
std::string colonSegmentAt(const Centreline& line, double along);

// Returns the metres along the line to its place next to this one.
double alongLine(const Centreline& line, const glm::dvec3& place);

// Returns the C-RADS class (Zalis et al., "CT colonography reporting and data system: a consensus proposal",
// Radiology 236 (2005)) by size and count alone: "C1" to "C4", for findings that a person kept; "" where
// there are candidates alone. C0, an inadequate study, and what is outside the colon are left to the reader.
std::string cradsClassOf(const std::vector<Finding>& findings);

}  // namespace stereonav
