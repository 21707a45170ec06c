#include "colon/instruments/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "colon/instruments/candidates.h"

namespace stereonav {
namespace {

constexpr double kMm = 1e-3;
constexpr double kRectum = 150 * kMm, kCaecum = 60 * kMm, kFlexure = 30 * kMm;

constexpr double kLeastWidth = 0.1;  // metres from side to side: what is narrower is no frame of a colon

// Distances along the line of its landmarks.
struct Landmarks {
    double descending = 0, splenic = 0, hepatic = 0, length = 0;
    bool found = false;
};

// The highest point beyond `side` (1: the patient's left) of the middle, from `first` on; -1: none.
int highest(const Centreline& line, double middle, double side, double away, std::size_t first) {
    int best = -1;
    for (std::size_t n = first; n < line.points.size(); ++n) {
        const glm::dvec3& p = line.points[n].position;
        if (side * (p.x - middle) < away) continue;
        if (best < 0 || p.z > line.points[best].position.z) best = static_cast<int>(n);
    }
    return best;
}

Landmarks landmarksOf(const Centreline& line) {
    Landmarks marks;
    std::vector<double> along{0};
    double left = -std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const glm::dvec3& p = line.points[n].position;
        left = std::max(left, p.x), right = std::min(right, p.x);
        if (n > 0) along.push_back(along.back() + glm::distance(p, line.points[n - 1].position));
    }
    marks.length = along.back();
    if (!(left - right >= kLeastWidth)) return marks;
    const double middle = 0.5 * (left + right), away = 0.1 * (left - right);
    const int splenic = highest(line, middle, 1, away, 0);
    if (splenic < 0) return marks;
    const int hepatic = highest(line, middle, -1, away, static_cast<std::size_t>(splenic));
    if (hepatic < 0) return marks;
    // Down from the flexure to where the line has risen by 3 cm again.
    int lowest = splenic;
    for (int n = splenic; n >= 0; --n) {
        const double z = line.points[n].position.z;
        if (z < line.points[lowest].position.z) lowest = n;
        if (z > line.points[lowest].position.z + 0.03 && along[splenic] - along[lowest] > 2 * kFlexure) break;
    }
    marks.descending = along[lowest];
    marks.splenic = along[splenic];
    marks.hepatic = along[hepatic];
    marks.found = true;
    return marks;
}

bool isSamePlace(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) <= kSamePlace;
}

// Returns whether the second finding's tip lies on the first one's head.
bool ofOnePolyp(const Finding& first, const Finding& second) {
    return first.polyp && second.polyp &&
           std::binary_search(first.polyp->vertices.begin(), first.polyp->vertices.end(), second.polyp->tip);
}

}  // namespace

bool Finding::right() const {
    if (!truth) return true;
    return polyp && std::abs(diameter() - truth->diameter) <= std::max(1 * kMm, 0.1 * truth->diameter);
}

FindingTool::FindingTool(const ColonScene& colon, std::shared_ptr<const JoinedWall> wall)
    : mColon(colon), mWall(std::move(wall)) {
    if (!colon.study.empty()) useStudy(colon.study);
}

void FindingTool::useStudy(const GreyVolume& study) {
    mStudy = &study;
    mBlur = blurAcrossWall(study, wall());
}

Finding FindingTool::at(const glm::dvec3& place) const {
    Finding finding;
    finding.asked = place;
    finding.polyp = polypAt(mWall->mesh, mWall->neighbours, place, polypSettingOf(mColon.volume.field.frame),
                            finding.problem);
    if (finding.polyp && mBlur) finding.values = valuesInside(*mStudy, wall(), *finding.polyp, *mBlur);
    const glm::dvec3 where = finding.polyp ? finding.polyp->middle : place;
    finding.along = alongLine(mColon.centreline, where);
    finding.segment = colonSegmentAt(mColon.centreline, finding.along);
    return finding;
}

std::vector<Finding> FindingTool::atTruth() const {
    std::vector<Finding> findings;
    for (const Polyp& polyp : mColon.polyps) {
        findings.push_back(at(polyp.position));
        findings.back().truth = polyp;
    }
    return findings;
}

std::vector<Finding> FindingTool::candidates(Progress& progress) const {
    std::vector<Finding> findings;
    CandidateSetting setting;
    setting.polyp = polypSettingOf(mColon.volume.field.frame);
    Progress looking(progress, 0, 0.5), measuring(progress, 0.5, 1);
    const std::vector<Candidate> found = polypCandidates(mWall->mesh, mWall->neighbours, setting, &looking);
    ProgressSteps measured(measuring, found.size(), "measuring candidates");
    for (const Candidate& candidate : found) {
        findings.push_back(at(glm::dvec3(wall().places[candidate.polyp.tip])));
        findings.back().candidate = true;
        findings.back().comment =
            fmt::format("candidate {}, score {:.2f} mm", findings.size(), 1e3 * candidate.score);
        measured.done();
    }
    return findings;
}

bool listsPlace(const std::vector<Finding>& findings, const glm::dvec3& place) {
    return std::any_of(findings.begin(), findings.end(),
                       [&place](const Finding& other) { return isSamePlace(other.asked, place); });
}

void addFinding(std::vector<Finding>& findings, Finding finding) {
    const auto same = [&finding](const Finding& other) {
        if (isSamePlace(other.asked, finding.asked)) return true;
        return (other.candidate || finding.candidate) && ofOnePolyp(other, finding);
    };
    const auto at = std::find_if(findings.begin(), findings.end(), same);
    if (at == findings.end()) {
        findings.push_back(std::move(finding));
        return;
    }
    if (finding.candidate) return;
    if (at->candidate || !finding.comment.empty()) at->comment = finding.comment;
    at->candidate = false;
    if (finding.truth) at->truth = finding.truth;
}

void noteDoubles(std::vector<Finding>& findings) {
    for (std::size_t b = 0; b < findings.size(); ++b)
        for (std::size_t a = 0; a < b; ++a) {
            if (!findings[b].problem.empty() || !ofOnePolyp(findings[a], findings[b])) continue;
            findings[b].doubled = true;
            findings[b].problem = fmt::format("the same polyp as finding {}", a + 1);
        }
}

double alongLine(const Centreline& line, const glm::dvec3& place) {
    double along = 0, walked = 0, least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const glm::dvec3& p = line.points[n].position;
        if (n > 0) walked += glm::distance(p, line.points[n - 1].position);
        if (const double away = glm::distance(p, place); away < least) least = away, along = walked;
    }
    return along;
}

std::string colonSegmentAt(const Centreline& line, double along) {
    const Landmarks marks = landmarksOf(line);
    if (!marks.found) return "";
    if (along < kRectum) return "rectum";
    if (along > marks.length - kCaecum) return "caecum";
    if (std::abs(along - marks.splenic) < kFlexure) return "splenic flexure";
    if (std::abs(along - marks.hepatic) < kFlexure) return "hepatic flexure";
    if (along > marks.hepatic) return "ascending";
    if (along > marks.splenic) return "transverse";
    return along > marks.descending ? "descending" : "sigmoid";
}

std::string cradsClassOf(const std::vector<Finding>& findings) {
    int middle = 0, large = 0, masses = 0;
    const auto unseen = [](const Finding& finding) { return finding.candidate; };
    if (!findings.empty() && std::all_of(findings.begin(), findings.end(), unseen)) return "";
    for (const Finding& finding : findings) {
        if (finding.doubled || finding.candidate) continue;
        const double mm = 1e3 * finding.diameter();
        middle += mm >= 6 && mm < 10;
        large += mm >= 10;
        masses += mm >= 30;
    }
    return masses > 0 ? "C4" : large > 0 || middle >= 3 ? "C3" : middle > 0 ? "C2" : "C1";
}

}  // namespace stereonav
