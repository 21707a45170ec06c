#include "app/view/panel/legend.h"

#include <imgui.h>

#include "app/view/panel/controls.h"
#include "engine/image/packed_color.h"
#include "engine/scene/live_paint.h"

namespace stereonav {
namespace {

void drawEntry(const LegendEntry& entry, int id) {
    const ImVec4 color(srgbFromLinear(entry.color.x), srgbFromLinear(entry.color.y),
                       srgbFromLinear(entry.color.z), 1);
    const float side = ImGui::GetTextLineHeight();
    ImGui::PushID(id);
    ImGui::ColorButton("##color", color, ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                       {1.6f * side, side});
    ImGui::SameLine();
    plainText(entry.text);
    ImGui::PopID();
}

}  // namespace

void drawLegend(const Scene& scene) {
    const auto* const live = scene.offered<LivePaint>();
    const std::shared_ptr<const PaintLegend> newest = live ? live->legend() : nullptr;
    const PaintLegend* const painted = newest ? newest.get() : scene.offered<const PaintLegend>();
    if (!painted) return;
    int id = 0;
    for (const Legend& legend : painted->legends) {
        quietText(legend.title);
        for (const LegendEntry& entry : legend.entries) drawEntry(entry, id++);
    }
    for (const std::string& note : painted->notes) quietText(note);
}

}  // namespace stereonav
