#include "app/view/panel/measure_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "app/view/measured_command.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/file_wish.h"
#include "app/view/panel/taken_lines.h"
#include "engine/scene/live_paint.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

// Draws heights over distance; the place under the pointer is also marked in the picture.
void drawProfile(Instruments& instruments, const MeasuredSurface& measured) {
    const std::vector<glm::dvec2>& profile = measured.profile;
    if (profile.size() < 2 || !(profile.back().x > profile.front().x)) return;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const glm::dvec2& point : profile)
        if (std::isfinite(point.y)) low = std::min(low, point.y), high = std::max(high, point.y);
    if (!(low <= high)) return quietText("no height is known along it");
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
        instruments.mark(measured.places[index]);
        tooltip(std::isfinite(profile[index].y)
                    ? fmt::format("{} along the line, {} m high", lengthText(profile[index].x),
                                  fixedText(profile[index].y, 1))
                    : fmt::format("{} along the line, no height is known", lengthText(profile[index].x)));
    }
    quietText(fmt::format("{} to {} m, {}", fixedText(low, 1), fixedText(high, 1), lengthText(length)));
}

// Draws the height of the eyes for lines of sight, which are among the figures of ground.
void drawEyeHeight(const ViewSession& session, MeasuredLine& line) {
    const Scene& scene = *session.open().scene;
    if (line.closed() || !scene.offered<LivePaint>()) return;
    double height = line.eyeHeight();
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    if (ImGui::DragScalar("above the ground##sight", ImGuiDataType_Double, &height, 0.1f, nullptr, nullptr,
                          "%.4g m") &&
        std::isfinite(height))
        line.setEyeHeight(std::clamp(height, 0.0, 1e6));
    tooltip("Height of both ends of the line of sight, which joins the last two places.");
}

// Draws buttons that save the line in the formats of the commands `profile` and `measure`.
void drawSaving(WindowJobs& jobs, const MeasuredLine& line) {
    static std::string file = "profile.svg";
    const bool busy = jobs.busy();
    fileField("measured file", "profile.svg", file, -5 * ImGui::GetFontSize());
    tooltip("A .svg or .csv of the profile, or a .geojson of the line with its figures.");
    ImGui::SameLine();
    if (button("Save##measured", "Writes the file. Files that exist stay: the new one gets a number.",
               !busy && !file.empty()))
        jobs.saveMeasured(line, file);
}

}  // namespace

void drawMeasurePanel(Instruments& instruments, WindowJobs& jobs, ViewSession& session,
                      const Clipboard& clipboard) {
    MeasuredLine* const line = instruments.measured();
    if (!line) return;
    instruments.mark(std::nullopt);  // set again where the pointer is over the profile
    bool on = instruments.measuring();
    if (ImGui::Checkbox("Clicks add places", &on)) instruments.measure(on);
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
    drawTakenLines(session, *line);
    if (!line->problem().empty()) wrappedText(line->problem());
    if (line->places().size() < 2)
        return quietText(empty ? "Two or more places are measured." : "One place: another one makes a line.");
    if (line->busy())
        quietText(fmt::format("measuring, {:.0f} %: any change stops it", 100 * line->fraction()));
    const MeasuredSurface* const measured = line->measured();
    if (!measured) return;
    factTable("measured", measured->facts);
    drawEyeHeight(session, *line);
    drawProfile(instruments, *measured);
    const std::string where = measuredWords(*session.open().scene, *line);
    if (ImGui::Button("Copy figures")) clipboard.copy(linesOf(measured->facts));
    if (where.empty()) return;
    ImGui::SameLine();
    if (button("Copy command",
               "Copies the command that measures the same without a window, as CSV and GeoJSON."))
        clipboard.copy(fmt::format("stereonav measure {} {} --csv measured.csv --geojson measured.geojson",
                                   shellWord(session.open().scene->name), where));
    drawSaving(jobs, *line);
}

}  // namespace stereonav
