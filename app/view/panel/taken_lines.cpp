#include "app/view/panel/taken_lines.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <glm/common.hpp>

#include "app/view/panel/controls.h"
#include "engine/scene/live_paint.h"
#include "engine/text/printable.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

// Takes a line over the ground; a notice says which parts outside it are left out.
void take(ViewSession& session, MeasuredLine& measured, const TerrainScene& terrain,
          const std::vector<glm::dvec2>& line, bool closed, const std::string& what) {
    std::vector<glm::dvec3> places;
    for (const glm::dvec2& place : line) {
        const double height = terrain.ground.contains(place) ? terrain.ground.heightAt(place) : std::nan("");
        if (std::isfinite(height)) places.emplace_back(place, height);
    }
    const std::size_t beside = line.size() - places.size();
    if (!measured.take(places, closed))
        return session.notify(beside == line.size()
                                  ? fmt::format("{}: all of it lies outside the ground", what)
                                  : fmt::format("{}: one place on the ground makes no line", what));
    std::string text = fmt::format("{}: {} places", what, measured.places().size());
    if (places.size() > MeasuredLine::kMost) text += fmt::format(", thinned from {}", places.size());
    if (beside > 0) text += fmt::format("; {} outside the ground were left out", beside);
    session.notify(text);
}

std::string nameOf(const PaintedLine& line, std::size_t n) {
    return line.name.empty() ? fmt::format("{} {}", line.closed ? "area" : "track", n + 1)
                             : printable(line.name);
}

}  // namespace

void drawTakenLines(ViewSession& session, MeasuredLine& line) {
    const Scene& scene = *session.open().scene;
    const auto* const terrain = scene.offered<const TerrainScene>();
    const auto* const paint = scene.offered<LivePaint>();
    if (!terrain || !paint) return;
    const std::shared_ptr<const PaintLegend> painted = paint->legend();
    const std::vector<PaintedLine>& lines = painted->lines;
    ImGui::BeginDisabled(lines.empty());
    if (lines.size() == 1 && ImGui::Button("Take track"))
        take(session, line, *terrain, lines[0].world, lines[0].closed, nameOf(lines[0], 0));
    if (lines.size() != 1) {
        ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
        if (ImGui::BeginCombo("##tracks", "Take track")) {
            for (std::size_t n = 0; n < lines.size(); ++n) {
                ImGui::PushID(static_cast<int>(n));
                if (ImGui::Selectable(nameOf(lines[n], n).c_str()))
                    take(session, line, *terrain, lines[n].world, lines[n].closed, nameOf(lines[n], n));
                ImGui::PopID();
            }
            ImGui::EndCombo();
        }
    }
    ImGui::EndDisabled();
    tooltip("Measures a line of the file of tracks (under Material) in place of this one.");
    ImGui::SameLine();
    const std::vector<PathSample>& flight = session.paths().path().samples();
    ImGui::BeginDisabled(flight.size() < 2);
    if (ImGui::Button("Take flight")) {
        std::vector<glm::dvec2> under;
        under.reserve(flight.size());
        for (const PathSample& sample : flight) under.emplace_back(sample.pose.position);
        take(session, line, *terrain, under, false, "the flight");
    }
    ImGui::EndDisabled();
    tooltip("Measures the ground under the flight that Z plays.");
}

}  // namespace stereonav
