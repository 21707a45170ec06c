#include "app/view/panel/findings_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <cfloat>

#include "app/view/panel/controls.h"
#include "app/view/panel/file_wish.h"

namespace stereonav {

bool FindingsPanel::inUse(Instruments& instruments) {
    const FindingList* const list = instruments.findings();
    return list && (list->clicks() || !list->rows().empty() || !list->candidates().empty());
}

std::optional<glm::dvec3> FindingsPanel::draw(Instruments& instruments, StudyReading& study,
                                              ViewSession& session, Notices& notices,
                                              const Clipboard& clipboard) {
    FindingList* const list = instruments.findings();
    if (!list) return std::nullopt;
    mChosen.reset();
    bool clicks = list->clicks();
    if (ImGui::Checkbox("Clicks add findings", &clicks)) instruments.clickFindings(clicks);
    tooltip(
        "A click on the picture, while nothing moves, or in a slice, measures the polyp there. Key, at any "
        "time: Ctrl+F");
    quietText(list->maker()->notice());
    if (!list->rows().empty()) {
        list->use();
        study.wanted(session);  // values of the study are shown
    }
    if (list->busy()) {
        const std::string text = fmt::format("{} {:.0f} %", list->doing(), 100 * list->fraction());
        ImGui::ProgressBar(static_cast<float>(list->fraction()), {-6 * ImGui::GetFontSize(), 0},
                           text.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel")) list->cancel();
    } else if (list->stopped()) {
        if (ImGui::SmallButton("Measure again")) list->goOn();
    }
    if (!list->problem().empty()) wrappedText(list->problem());
    if (!list->told().empty()) quietText(list->told());
    if (list->rows().empty()) quietText("No findings yet.");
    if (!list->summary().empty()) wrappedText(list->summary());
    // Copied, since buttons change the list.
    const std::vector<FindingList::Row> rows = list->rows();
    for (std::size_t n = 0; n < rows.size(); ++n) drawRow(session, *list, rows[n], std::to_string(n + 1));
    if (list->canPutBack()) {
        if (ImGui::SmallButton("Undo remove")) list->putBack();
        tooltip("Puts back what was removed last.");
    }
    drawCandidates(session, study, *list);
    drawFiles(session, notices, clipboard, *list);
    return mChosen;
}

void FindingsPanel::goTo(ViewSession& session, const SurfaceFinding& finding) {
    mChosen = finding.middle;
    if (finding.view) session.flyTo(*finding.view);
}

void FindingsPanel::drawRow(ViewSession& session, FindingList& list, const FindingList::Row& row,
                            const std::string& name) {
    const SurfaceFinding& finding = row.finding;
    ImGui::PushID(row.id);
    const std::string size = !finding.measured ? "not measured yet"
                             : finding.found   ? fmt::format("{:.1f} mm", 1e3 * finding.diameter)
                                               : "no polyp";
    const float button = 1.8f * ImGui::GetFontSize();
    if (ImGui::Selectable(fmt::format("{}:  {}", name, size).c_str(), false, 0,
                          {ImGui::GetContentRegionAvail().x - button, 0}))
        goTo(session, finding);
    tooltip("Fly there, and show it in the slices.");
    ImGui::SameLine();
    if (ImGui::SmallButton("\u2715")) list.remove(row.id);
    tooltip("Removes this finding.");
    ImGui::Indent();
    for (const std::string& line : finding.lines) quietText(line);
    if (!row.note.empty()) wrappedText(row.note);
    drawComment(list, row);
    ImGui::Unindent();
    ImGui::PopID();
}

void FindingsPanel::drawComment(FindingList& list, const FindingList::Row& row) {
    const std::string& comment = row.finding.comment;
    if (mCommenting != row.id) {
        if (!comment.empty()) wrappedText(comment);
        if (ImGui::SmallButton(comment.empty() ? "+ Comment" : "Edit")) {
            mCommenting = row.id;
            mComment = comment;
            mFocus = true;
        }
        return;
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (std::exchange(mFocus, false)) ImGui::SetKeyboardFocusHere();
    const bool done = ImGui::InputText("##comment", &mComment, ImGuiInputTextFlags_EnterReturnsTrue);
    if (!done && !ImGui::IsItemDeactivated()) return;
    list.comment(row.id, mComment);
    mCommenting = 0;
}

void FindingsPanel::drawCandidates(ViewSession& session, StudyReading& study, FindingList& list) {
    if (ImGui::Button("Candidates")) {
        study.wanted(session);
        list.findCandidates();
    }
    tooltip(
        "Looks for places that are shaped like polyps. Look at each: it is a finding only once it is kept.");
    if (list.candidates().empty()) return;
    ImGui::SameLine();
    if (ImGui::Button("Hide")) return list.dropCandidates();
    const std::vector<FindingList::Row> candidates = list.candidates();
    for (const FindingList::Row& row : candidates) {
        ImGui::PushID(row.id);
        const float button = 4.0f * ImGui::GetFontSize();
        const std::string label = fmt::format("candidate: {:.1f} mm", 1e3 * row.finding.diameter);
        ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(110, 190, 255, 255));
        if (ImGui::Selectable(label.c_str(), false, 0, {ImGui::GetContentRegionAvail().x - button, 0}))
            goTo(session, row.finding);
        ImGui::PopStyleColor();
        tooltip("Fly there. A candidate only, to be looked at: " + row.finding.comment);
        ImGui::SameLine();
        ImGui::BeginDisabled(!row.note.empty());
        if (ImGui::SmallButton("Keep")) list.keep(row.id);
        ImGui::EndDisabled();
        tooltip(row.note.empty() ? "Keeps the candidate as a finding." : row.note);
        ImGui::PopID();
    }
}

void FindingsPanel::drawFiles(const ViewSession& session, Notices& notices, const Clipboard& clipboard,
                              FindingList& list) {
    if (list.rows().empty()) return;
    fileField("page", "findings.html", mPage);
    if (button("Write page", "One HTML file with the list and pictures of each.", !list.busy()))
        notices.tryTo([&] { list.writePage(mPage); });
    ImGui::SameLine();
    if (button("Copy command",
               fmt::format(
                   "Copies the command that goes on with the list without a window. The list is kept in {}",
                   list.file().string())))
        clipboard.copy(fmt::format("stereonav findings '{}' --file '{}' --page findings.html",
                                   session.open().scene->name, list.file().string()));
    fileField("report", "findings.dcm", mReport);
    const std::string why = list.maker()->whyNoReport();
    if (button("Write DICOM report",
               why.empty() ? "A DICOM structured report of the list, for archives."
                           : "Not available: " + why + ".",
               !list.busy() && why.empty()))
        notices.tryTo([&] { list.writeReport(mReport); });
    quietText("kept in " + list.file().string());
}

}  // namespace stereonav
