// Findings of a reader: measurements at a place of a colon, its position in the colon, and the conclusion
// from a list of them. Not a medical device.
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

// Largest number of findings in a document: opening it measures each, and compares each with the others.
constexpr std::size_t kMostFindings = 1000;

struct Finding {
    glm::dvec3 asked{0.0};  // world, metres: where it was searched
    std::string comment;
    std::optional<Polyp> truth;  // for a generated colon

    std::optional<MeasuredPolyp> polyp;
    std::string problem;                // why there is no polyp, or a note on it; ""
    double along = 0;                   // metres from the rectum
    std::string segment;                // segment of the colon, found by landmarks; "": unknown
    std::optional<PolypValues> values;  // CT values inside the polyp; empty: unknown

    bool candidate = false;  // found by the program, and not yet kept by a person

    double diameter() const { return polyp ? polyp->widest.length : 0; }  // metres
    bool doubled = false;  // shows the same polyp as an earlier one in its list
    // Returns whether the diameter equals the true one within 1 mm or a tenth. True where there is no truth.
    bool right() const;
};

class FindingTool {
public:
    // colon must outlive this object; wall: of that colon. Values are read from the colon's `study`, where it
    // has one.
    FindingTool(const ColonScene& colon, std::shared_ptr<const JoinedWall> wall);

    // Reads values from this study from now on; it must outlive this object.
    void useStudy(const GreyVolume& study);

    // Measures the polyp at a place: world, metres. `problem` says so where there is none.
    Finding at(const glm::dvec3& place) const;
    // Measures the polyps of a generated colon at their true places.
    std::vector<Finding> atTruth() const;
    // Finds places that look like polyps (candidates.h), as candidates, with a comment. Throws Cancelled.
    std::vector<Finding> candidates(Progress& progress) const;

    const WallMesh& wall() const { return mWall->mesh; }

private:
    const ColonScene& mColon;
    std::shared_ptr<const JoinedWall> mWall;
    const GreyVolume* mStudy = nullptr;  // null: no values
    std::optional<double> mBlur;         // blur of mStudy across the wall, metres
};

// Adds a finding to a list, in which each place is one entry: it replaces an entry at the same place (within
// kSamePlace) or, where either is a candidate, of the same polyp. A finding from a person is no candidate any
// more, and keeps the person's comment.
void addFinding(std::vector<Finding>& findings, Finding finding);
constexpr double kSamePlace = 0.0005;  // metres
// Returns whether the list already has that place, so that it need not be measured.
bool listsPlace(const std::vector<Finding>& findings, const glm::dvec3& place);

// Marks findings that show the same polyp: all but the first get a note. None is removed.
void noteDoubles(std::vector<Finding>& findings);

// Returns the segment of the colon at a place on the line, metres from its start: "rectum", "sigmoid",
// "descending", "splenic flexure", "transverse", "hepatic flexure", "ascending", "caecum"; "" where the line
// does not have two flexures. By landmarks only: the flexures are the highest places on the left and, after
// that, on the right; the descending colon reaches down to where the line rises again; the rectum is the
// first 15 cm, the caecum the last 6 cm.
std::string colonSegmentAt(const Centreline& line, double along);

// Returns the metres along the line of its point nearest to a place.
double alongLine(const Centreline& line, const glm::dvec3& place);

// Returns the C-RADS class (Zalis et al., "CT colonography reporting and data system: a consensus proposal",
// Radiology 236 (2005)) from size and count only: "C1" to "C4", for findings that a person kept; "" where
// there are only candidates. C0, an inadequate study, and findings outside the colon are left to the reader.
std::string cradsClassOf(const std::vector<Finding>& findings);

}  // namespace stereonav
