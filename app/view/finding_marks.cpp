#include "app/view/finding_marks.h"

#include <glm/geometric.hpp>

#include "app/output/eye_marks.h"
#include "app/view/frame_views.h"

namespace stereonav {
namespace {

const glm::u8vec3 kFinding(255, 214, 74), kCandidate(110, 190, 255);
constexpr double kLift = 3e-4;  // metres towards the eye, as a pixel's depth is that of its middle

class Marker {
public:
    Marker(const FrameRequest& request, const Plane<float>& viewDepth, const glm::ivec2& guard, float letter,
           std::vector<OverlayMark>& marks)
        : mViews(viewsOf(request)), mDepth(viewDepth), mGuard(guard), mLetter(letter), mMarks(marks) {}

    void add(const FindingList::Row& row, const std::string& label, const glm::u8vec3& ink) const {
        const SurfaceFinding& finding = row.finding;
        for (const glm::dvec3& place : finding.outline) point(place, "", ink);
        for (const glm::dvec3& place : finding.across) point(place, "", ink);
        // The middle of the diameter lies inside the tissue: the label stands on the nearest place of the
        // wall.
        const glm::dvec3& at =
            finding.across.empty() ? finding.asked : finding.across[finding.across.size() / 2];
        point(at, label, ink);
    }

private:
    void point(const glm::dvec3& world, const std::string& text, const glm::u8vec3& ink) const {
        const glm::dvec3 towards = mViews.left.eye - world;
        const double away = glm::length(towards);
        if (!(away > 4 * kLift)) return;
        const auto at = markOf(mViews, mDepth, world + kLift / away * towards, mGuard);
        if (!at) return;
        OverlayMark mark{glm::vec2(at->mark.left), glm::vec2(at->mark.right), text, {}, text.empty()};
        mark.textAt = {0.8f * mLetter, -1.8f * mLetter};
        mark.ink = ink;
        mMarks.push_back(std::move(mark));
    }

    StereoViews mViews;
    const Plane<float>& mDepth;
    glm::ivec2 mGuard;
    float mLetter;
    std::vector<OverlayMark>& mMarks;
};

}  // namespace

void addFindingMarks(const FindingList& findings, const FrameRequest& request, const Plane<float>& viewDepth,
                     const glm::ivec2& guard, float letter, std::vector<OverlayMark>& marks) {
    if (findings.rows().empty() && findings.candidates().empty()) return;
    const Marker marker(request, viewDepth, guard, letter, marks);
    for (const FindingList::Row& row : findings.candidates())
        if (row.note.empty()) marker.add(row, "candidate", kCandidate);
    for (std::size_t n = 0; n < findings.rows().size(); ++n)
        marker.add(findings.rows()[n], std::to_string(n + 1), kFinding);
}

}  // namespace stereonav
