#include "app/view/panel/measure_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "app/output/length_text.h"
#include "app/view/panel/controls.h"
#include "engine/scene/place_reader.h"

namespace stereonav {
namespace {

// The command that measures the same, with files of it; "" where the scene has no such command or a place has
// no coordinates.
std::string commandOf(const Scene& scene, const MeasuredLine& line) {
    const auto* const reader = scene.offered<PlaceReader>();
    if (!reader || !scene.offered<LineMeasurer>()) return "";
    const bool area = line.closed() && line.places().size() > 2;
    std::string text;
    for (const glm::dvec3& place : line.places()) {
        glm::dvec2 at(place);
        for (const Fact& fact : reader->readPlace(place))
            if (fact.key == "reference")
                if (const auto* const numbers = std::get_if<FactNumbers>(&fact.value))
                    at = {numbers->at(0), numbers->at(1)};
        text += fmt::format("{}{:.10g},{:.10g}", text.empty() ? "" : ",", at.x, at.y);
    }
    return fmt::format("stereonav measure '{}' {} {} --csv measured.csv --geojson measured.geojson",
                       scene.name, area ? "--area" : "--line", text);
}

// Heights over the distance; under the pointer the place is shown in the picture too.
void drawProfile(PanelHost& host, const MeasuredSurface& measured) {
    const std::vector<glm::dvec2>& profile = measured.profile;
    if (profile.size() < 2 || !(profile.back().x > profile.front().x)) return;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const glm::dvec2& point : profile)
        if (std::isfinite(point.y)) low = std::min(low, point.y), high = std::max(high, point.y);
    if (!(low <= high)) return quietText(host, "no height is known along it");
    if (high == low) low -= 0.5, high += 0.5;
    const float font = ImGui::GetFontSize();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 6 * font), corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##profile", size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_PlotLines);
    list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    const double from = profile.front().x, length = profile.back().x - from;
    const auto at = [&](const glm::dvec2& point) {
        return ImVec2(
            corner.x + static_cast<float>((point.x - from) / length) * size.x,
            corner.y + (0.95f - 0.9f * static_cast<float>((point.y - low) / (high - low))) * size.y);
    };
    for (std::size_t n = 1; n < profile.size(); ++n)
        if (std::isfinite(profile[n - 1].y) && std::isfinite(profile[n].y))
            list.AddLine(at(profile[n - 1]), at(profile[n]), ink, 1.5f);
    if (ImGui::IsItemHovered()) {
        const double distance =
            from + length * std::clamp((ImGui::GetMousePos().x - corner.x) / size.x, 0.0f, 1.0f);
        const auto next = std::lower_bound(profile.begin(), profile.end() - 1, distance,
                                           [](const glm::dvec2& point, double x) { return point.x < x; });
        const std::size_t index = static_cast<std::size_t>(next - profile.begin());
        const ImVec2 top = at({profile[index].x, high}), bottom = at({profile[index].x, low});
        list.AddLine(top, bottom, ink);
        host.markWorld(measured.places[index]);
        tooltip(std::isfinite(profile[index].y)
                    ? fmt::format("{} along the line, {:.1f} m high", lengthText(profile[index].x),
                                  profile[index].y)
                    : fmt::format("{} along the line, no height is known", lengthText(profile[index].x)));
    }
    quietText(host, fmt::format("{:.1f} to {:.1f} m, {}", low, high, lengthText(length)));
}

}  // namespace

void drawMeasurePanel(PanelHost& host) {
    MeasuredLine* const line = host.measured();
    if (!line) return;
    host.markWorld(std::nullopt);  // unless the pointer is over the profile
    bool on = host.measuring();
    if (ImGui::Checkbox("Clicks add places", &on)) host.measure(on);
    tooltip("Each click on the picture, while nothing moves, is the line's next place. Key: Ctrl+M");
    const bool empty = line->places().empty();
    ImGui::BeginDisabled(empty);
    if (ImGui::Button("Remove last")) line->removeLast();
    ImGui::SameLine();
    if (ImGui::Button("Clear")) line->clear();
    ImGui::SameLine();
    bool closed = line->closed();
    if (ImGui::Checkbox("Area", &closed)) line->setClosed(closed);
    tooltip("Joins the last place to the first: three places or more.");
    ImGui::EndDisabled();
    if (!line->problem().empty()) wrappedText(line->problem());
    if (line->places().size() < 2)
        return quietText(
            host, empty ? "Two places and more are measured." : "One place: another one makes a line.");
    if (line->busy()) quietText(host, "measuring");
    const MeasuredSurface* const measured = line->measured();
    if (!measured) return;
    factTable(host, "measured", measured->facts);
    drawProfile(host, *measured);
    const std::string command = commandOf(*host.session()->open().scene, *line);
    if (ImGui::Button("Copy figures")) host.copy(linesOf(measured->facts));
    if (command.empty()) return;
    ImGui::SameLine();
    if (ImGui::Button("Copy command")) host.copy(command);
    tooltip("Measures the same without a window, and writes it as CSV and GeoJSON.");
}

}  // namespace stereonav
