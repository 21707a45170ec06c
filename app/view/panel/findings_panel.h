// Findings on a surface: a list with figures and comments, candidates, and a page of them.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "app/view/clipboard.h"
#include "app/view/instruments.h"
#include "app/view/notices.h"

namespace stereonav {

class FindingsPanel {
public:
    static bool has(Instruments& instruments) { return instruments.findings() != nullptr; }
    // Returns whether the panel has something to show from the beginning.
    static bool inUse(Instruments& instruments);
    // Draws the panel; returns the place of a finding that was chosen, for the slices.
    std::optional<glm::dvec3> draw(Instruments& instruments, StudyReading& study, ViewSession& session,
                                   Notices& notices, const Clipboard& clipboard);

private:
    void goTo(ViewSession& session, const SurfaceFinding& finding);
    void drawRow(ViewSession& session, FindingList& list, const FindingList::Row& row,
                 const std::string& name);
    void drawComment(FindingList& list, const FindingList::Row& row);
    void drawCandidates(ViewSession& session, StudyReading& study, FindingList& list);
    void drawFiles(const ViewSession& session, Notices& notices, const Clipboard& clipboard,
                   FindingList& list);

    int mCommenting = 0;  // row whose comment is edited; 0: none
    bool mFocus = false;  // whether the field was just opened
    std::string mComment, mPage = "findings.html", mReport = "findings.dcm";
    std::optional<glm::dvec3> mChosen;
};

}  // namespace stereonav
