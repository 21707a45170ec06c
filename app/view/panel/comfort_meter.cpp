#include "app/view/panel/comfort_meter.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/view/panel/controls.h"
#include "app/view/status.h"

namespace stereonav {
namespace {

constexpr double kLowest = -0.06, kHighest = 0.08;  // shares of the width that the meter spans

}  // namespace

float comfortMeterWidth() {
    return 9 * ImGui::GetFontSize();
}

void drawComfortMeter(const PanelHost& host, const ViewFrame& frame) {
    const ImVec2 size(comfortMeterWidth(), ImGui::GetFontSize());
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##comfort", size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto place = [&](double parallax) {
        const double share = std::clamp((parallax - kLowest) / (kHighest - kLowest), 0.0, 1.0);
        return from.x + static_cast<float>(share) * size.x;
    };
    const float top = from.y + 0.2f * size.y, bottom = from.y + 0.85f * size.y;
    list.AddRectFilled({from.x, top}, {from.x + size.x, bottom}, ImGui::GetColorU32(ImGuiCol_FrameBg), 2);
    list.AddRectFilled({place(kNearestParallax), top}, {place(kFarthestParallax), bottom},
                       ImGui::GetColorU32(ImGuiCol_FrameBgActive));
    const ScreenWords onScreen = host.onScreen(frame);
    const std::string warning = onScreen.warning.empty() ? warningLine(frame) : onScreen.warning;
    const ImVec4 color = warning.empty() ? accentColor(host.look()) : warningColor(host.look());
    const float left = place(frame.nearParallax), right = std::max(place(frame.farParallax), left + 2);
    list.AddRectFilled({left, top + 2}, {right, bottom - 2}, ImGui::GetColorU32(color), 2);
    list.AddLine({place(0), from.y}, {place(0), from.y + size.y}, ImGui::GetColorU32(ImGuiCol_Text));
    tooltip(fmt::format(
        "Parallax {:+.1f} to {:+.1f} % of the width: left of the line stands before the screen, right of "
        "it behind.\nComfortable: {:.0f} % in all, within {:+.1f} and {:+.1f} %.\n{}{}{}",
        100 * frame.nearParallax, 100 * frame.farParallax, 100 * kParallaxBudget, 100 * kNearestParallax,
        100 * kFarthestParallax, onScreen.parallax, warning.empty() ? "" : "\n", warning));
}

}  // namespace stereonav
