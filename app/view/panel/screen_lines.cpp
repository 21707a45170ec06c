#include "app/view/panel/screen_lines.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "app/view/panel/controls.h"
#include "app/view/scene_changes.h"
#include "app/view/view_display.h"

namespace stereonav {

void drawScreen(const PanelParts& parts) {
    const ScreenAnswer screen = parts.display.screen();
    if (!screen.asks || !parts.session || !parts.session->stereoOn()) {
        quietText(screen.words);
        tooltip("Parallax in millimetres and degrees follows from this size. It is kept for this monitor.");
        return;
    }
    static double width_mm = 0;  // the number that is being typed
    if (!(width_mm > 0)) width_mm = std::round(screen.width_mm);
    quietText("How wide is this screen? It does not report it, so parallax in mm is a guess.");
    ImGui::SetNextItemWidth(5 * ImGui::GetFontSize());
    ImGui::InputDouble("mm##screen", &width_mm, 0, 0, "%.0f");
    ImGui::SameLine();
    if (button("Set", "The width of the whole monitor. It is kept, and can be changed here at any time.",
               width_mm > 0 && std::isfinite(width_mm)))
        parts.changes.set("screen-width", fmt::format("{:.6g}", width_mm));
    ImGui::SameLine();
    if (button("Not now", "The program does not ask again.")) parts.display.leaveUnknown();
}

}  // namespace stereonav
