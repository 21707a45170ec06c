#include "app/view/panel/path_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/output/length_text.h"
#include "app/view/panel/controls.h"
#include "engine/camera/keyframes.h"
#include "engine/camera/path_edit.h"

namespace stereonav {
namespace {

constexpr double kSmoothSeconds = 0.5;

bool button(const char* label, const char* tip) {
    const bool pressed = ImGui::Button(label);
    tooltip(tip);
    return pressed;
}

void drawEdits(PanelHost& host, ViewSession& session) {
    const RecordedPath& path = session.path();
    static double from = 0, to = 1;  // shares of the duration
    ImGui::SetNextItemWidth(-FLT_MIN);
    float ends[2] = {static_cast<float>(from), static_cast<float>(to)};
    if (ImGui::SliderFloat2("##ends", ends, 0, 1, "%.3f")) {
        from = std::min(ends[0], ends[1]);
        to = std::max(ends[0], ends[1]);
    }
    tooltip("The part that Trim keeps, from and to, of the duration.");
    if (button("Trim", "Keeps that part.")) {
        const double start = path.startTime(), duration = path.duration();
        session.editPath([=](const RecordedPath& all) {
            return trimmed(all, start + from * duration, start + to * duration);
        });
        from = 0;
        to = 1;
    }
    ImGui::SameLine();
    if (button("Smooth", "Takes out what shakes within half a second; the ends stay."))
        session.editPath([](const RecordedPath& all) { return smoothed(all, kSmoothSeconds); });
    ImGui::SameLine();
    if (button("Even pace", "The same way in the same time, at one speed."))
        session.editPath([](const RecordedPath& all) { return evenlyPaced(all, std::nullopt); });
    if (button("Undo##path", "The path before the last change.")) session.undoPath();
    ImGui::SameLine();
    if (button("Save", "Writes the path as flight_0001.gltf and so on.")) session.savePath();
    (void)host;
}

// Through the places that are kept, in their order.
void drawThroughPlaces(PanelHost& host, ViewSession& session) {
    const Bookmarks* const places = host.places();
    if (!places || places->list().size() < 2) return;
    if (!button("Fly through the places",
                "A path through the kept places, in their order, smooth and eased."))
        return;
    std::vector<Pose> poses;
    for (const Bookmark& place : places->list()) poses.push_back(place.pose);
    session.editPath([&](const RecordedPath&) {
        return pathThrough(timedKeyframes(poses, session.flight().speed()), true);
    });
}

void drawMovie(PanelHost& host, ViewSession& session) {
    static MovieWish movie{"flight.mp4"};
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##movie", "flight.mp4", &movie.file);
    tooltip("An .mp4 (H.264), an .mkv (lossless), an .avi; or the name of a folder, for pictures.");
    int size[2] = {movie.width, movie.height};
    ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
    if (ImGui::InputInt2("##size", size)) {
        movie.width = std::clamp(size[0], 16, 8192);
        movie.height = std::clamp(size[1], 16, 8192);
    }
    tooltip("Pixels of one eye, across and down.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(4.5f * ImGui::GetFontSize());
    ImGui::DragScalar("##fps", ImGuiDataType_Double, &movie.fps, 0.1f, nullptr, nullptr, "%.4g /s");
    movie.fps = std::clamp(movie.fps, 1.0, 240.0);
    tooltip("Frames a second.");
    ImGui::SameLine();
    const bool busy = host.job() && host.job()->running();
    ImGui::BeginDisabled(busy || movie.file.empty() || session.path().samples().size() < 2);
    if (ImGui::Button("Make movie")) host.makeMovie(movie);
    ImGui::EndDisabled();
    tooltip("Of this path, in the mode that is shown. It goes on beside the flight.");
}

}  // namespace

void drawPathPanel(PanelHost& host, ViewSession& session) {
    if (button(session.recording() ? "End recording" : "Record", "Key: z")) host.act({ViewCommand::Record});
    ImGui::SameLine();
    if (button(session.playing() ? "Stop" : "Play", "Key: Shift+Z")) host.act({ViewCommand::Play});
    ImGui::SameLine();
    if (button("Home", "Key: Space")) host.act({ViewCommand::Home});
    const RecordedPath& path = session.path();
    const bool any = path.samples().size() > 1;
    quietText(host,
              any ? fmt::format("A flight of {:.1f} s, {} places.", path.duration(), path.samples().size())
                  : "No flight yet: Record makes one.");
    if (any) drawEdits(host, session);
    drawThroughPlaces(host, session);
    drawMovie(host, session);
    bool byDistance = session.speedByDistance();
    if (ImGui::Checkbox("speed by the distance ahead", &byDistance)) host.act({ViewCommand::SpeedByDistance});
    tooltip(
        "What is ahead is reached in about four seconds, near or far; over the sky the speed is as ever. "
        "Key: "
        "Shift+F");
    quietText(host, fmt::format("speed {}/s: the wheel changes it, Shift is four times",
                                lengthText(session.speed())));
}

}  // namespace stereonav
