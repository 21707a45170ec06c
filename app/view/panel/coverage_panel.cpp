#include "app/view/panel/coverage_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <numbers>

#include "app/view/panel/controls.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Returns true when a drag ends: coverage is not computed again during it. `value` is divided by `unit` for
// display.
bool dragged(const char* label, double& value, double unit, double least, double most, const char* format,
             const char* tip, bool& editing) {
    double shown = value / unit;
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    if (ImGui::DragScalar(label, ImGuiDataType_Double, &shown, static_cast<float>(most / 400), &least, &most,
                          format, ImGuiSliderFlags_AlwaysClamp)) {
        value = shown * unit;
        editing = true;
    }
    const bool done = ImGui::IsItemDeactivatedAfterEdit();
    tooltip(tip);
    return done;
}

}  // namespace

void CoveragePanel::drawSettings(LiveCoverage& coverage) {
    if (!mEditing) mEdited = coverage.looking();
    bool done = dragged("distance", mEdited.within, 0.001, 1, 1000, "%.0f mm",
                        "Largest distance from the eye at which wall counts as seen.", mEditing);
    done |= dragged("angle", mEdited.angle, kDegree, 1, 90, "%.0f\u00b0",
                    "Largest angle between a ray and the wall's normal at which wall counts as seen: 90 "
                    "counts all that is on screen.",
                    mEditing);
    done |=
        dragged("smallest patch", mEdited.smallestPatch, 1e-6, 0, 10000, "%.0f mm\u00b2",
                "Unseen patches of this area and more are listed: 300 is usual in the literature.", mEditing);
    if (!done) return;
    mEditing = false;
    coverage.judgeBy(mEdited);
}

void CoveragePanel::drawUnseen(LiveCoverage& coverage, ViewSession& session, AskedActions& actions) {
    constexpr float kRows = 8;
    const std::vector<UnseenPart>& unseen = coverage.soFar().unseen;
    if (unseen.empty()) return quietText("No patch of that size was left unseen.");
    quietText(fmt::format("{} unseen patch{}: area, place along the line", unseen.size(),
                          unseen.size() > 1 ? "es" : ""));
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const float rows = std::min(kRows, static_cast<float>(unseen.size()));
    if (ImGui::BeginChild("unseen", {0, rows * row})) {
        for (std::size_t n = 0; n < unseen.size(); ++n) {
            const UnseenPart& part = unseen[n];
            const auto& chosen = coverage.chosen();
            ImGui::PushID(static_cast<int>(n));
            ImGui::BeginDisabled(!part.view);
            if (ImGui::Selectable("##part", chosen && chosen->place == part.place)) {
                coverage.choose(part);
                session.flyTo(*part.view);
            }
            ImGui::EndDisabled();
            if (!part.view) tooltip("No view of it has room for an eye.");
            const float font = ImGui::GetFontSize();
            for (const auto& [end, text] : {std::pair(6.5f, fmt::format("{:.0f} mm\u00b2", 1e6 * part.area)),
                                            std::pair(11.5f, fmt::format("{:.0f} mm", 1e3 * part.along))}) {
                ImGui::SameLine(end * font - ImGui::CalcTextSize(text.c_str()).x);
                ImGui::TextUnformatted(text.c_str());
            }
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
    if (button("Next", "Flies to the next smaller patch. Key: F8")) actions.ask({ViewCommand::NextUnseen});
    ImGui::SameLine();
    if (button("Previous", "Flies to the next larger patch. Key: Shift+F8"))
        actions.ask({ViewCommand::PreviousUnseen});
}

void CoveragePanel::draw(LiveCoverage* coverage, ViewSession& session, AskedActions& actions) {
    if (!coverage) return;
    bool on = coverage->on();
    if (on && !mWasOn) ImGui::SetNextItemOpen(true);  // opened when the key has switched it on
    mWasOn = on;
    if (!ImGui::CollapsingHeader("Coverage")) return;
    if (ImGui::Checkbox("Follow what is seen", &on)) actions.ask({ViewCommand::ToggleCoverage});
    tooltip(
        "Tints the wall that the left eye has not shown yet, now or in earlier flights of this study. Key: "
        "F9");
    if (!coverage->on()) return;
    const CoverageSoFar& now = coverage->soFar();
    if (now.any)
        wrappedText(fmt::format("{:.1f} % of the wall seen", now.percent));
    else
        quietText("looking at the wall");
    quietText(fmt::format("{} flown in {:.0f} s{}", lengthText(coverage->metres()), coverage->seconds(),
                          now.any && coverage->busy() ? ", still looking" : ""));
    if (const std::string problem = coverage->problem(); !problem.empty()) wrappedText(problem);
    drawSettings(*coverage);
    if (button("+ One way",
               "Counts the scene's own flight as flown, with this picture's field of view and shape."))
        coverage->addOwnFlight(false);
    ImGui::SameLine();
    if (button("+ Both ways", "Counts the scene's own flight there and back as flown."))
        coverage->addOwnFlight(true);
    if (button("Start again", "Forgets what was flown.")) coverage->startAgain();
    if (now.any) drawUnseen(*coverage, session, actions);
}

}  // namespace stereonav
