#include "app/view/panel/comfort_meter.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/view/panel/controls.h"
#include "app/view/status.h"

namespace stereonav {
namespace {

constexpr double kLowest = ParallaxHistogram::kLowest, kHighest = ParallaxHistogram::kHighest;

// Draws how much of the picture lies at each parallax, as square roots, so that small shares are visible.
void drawHistogram(const ParallaxHistogram& histogram, ImDrawList& list, const ImVec2& from,
                   const ImVec2& size) {
    const std::int32_t most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    if (most <= 0) return;
    const float step = size.x / ParallaxHistogram::kBins;
    for (int bin = 0; bin < ParallaxHistogram::kBins; ++bin) {
        const std::int32_t count = histogram.counts[static_cast<std::size_t>(bin)];
        if (count <= 0) continue;
        const float height = size.y * static_cast<float>(std::sqrt(static_cast<double>(count) / most));
        const float x = from.x + step * static_cast<float>(bin), bottom = from.y + size.y;
        list.AddRectFilled({x, bottom - height}, {x + step, bottom},
                           ImGui::GetColorU32(ImGuiCol_ButtonHovered));
    }
}

}  // namespace

float comfortMeterWidth() {
    return 9 * ImGui::GetFontSize();
}

void drawComfortMeter(const ViewDisplay& display, const ViewFrame& frame) {
    const ImVec2 size(comfortMeterWidth(), ImGui::GetFontSize());
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##comfort", size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto place = [&](double parallax) {
        const double share = std::clamp((parallax - kLowest) / (kHighest - kLowest), 0.0, 1.0);
        return from.x + static_cast<float>(share) * size.x;
    };
    const float top = from.y + 0.25f * size.y, bottom = from.y + 0.75f * size.y;
    list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg), 2);
    list.AddRectFilled({place(kNearestParallax), from.y}, {place(kFarthestParallax), from.y + size.y},
                       ImGui::GetColorU32(ImGuiCol_FrameBgActive));
    const ScreenWords onScreen = display.wordsOf(frame);
    drawHistogram(frame.parallax, list, from, size);
    const std::string warning = onScreen.warning.empty() ? warningLine(frame) : onScreen.warning;
    const ImVec4 color = warning.empty() ? accentNow() : warningNow();
    const float left = place(frame.nearParallax), right = std::max(place(frame.farParallax), left + 2);
    list.AddRectFilled({left, top + 1}, {right, bottom - 1}, ImGui::GetColorU32(color), 2);
    list.AddLine({place(0), from.y}, {place(0), from.y + size.y}, ImGui::GetColorU32(ImGuiCol_Text));
    tooltip(fmt::format(
        "Parallax {:+.1f} to {:+.1f} % of the width: left of the line stands before the screen, right of "
        "it behind.\nComfortable: {:.0f} % in all, within {:+.1f} and {:+.1f} %.\n{}{}{}",
        100 * frame.nearParallax, 100 * frame.farParallax, 100 * kParallaxBudget, 100 * kNearestParallax,
        100 * kFarthestParallax, onScreen.parallax, warning.empty() ? "" : "\n", warning));
}

}  // namespace stereonav
