// Findings on a surface: a list with figures and comments, candidates, a page of them.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "app/view/panel/panel_host.h"

namespace stereonav {

class FindingsPanel {
public:
    static bool has(PanelHost& host) { return host.findings() != nullptr; }
    // Whether there is something to be seen in it without asking.
    static bool inUse(PanelHost& host);
    // A place that the slices are to go to: of a finding that was chosen.
    std::optional<glm::dvec3> draw(PanelHost& host);

private:
    void goTo(PanelHost& host, const SurfaceFinding& finding);
    void drawRow(PanelHost& host, FindingList& list, const FindingList::Row& row, const std::string& name);
    void drawComment(FindingList& list, const FindingList::Row& row);
    void drawCandidates(PanelHost& host, FindingList& list);
    void drawFiles(PanelHost& host, FindingList& list);

    int mCommenting = 0;  // the row whose comment is edited; 0: none
    bool mFocus = false;  // the field for it was just opened
    std::string mComment, mPage = "findings.html", mReport = "findings.dcm";
    std::optional<glm::dvec3> mChosen;
};

}  // namespace stereonav
