#include "app/view/panel/path_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "app/view/keyframe_edit.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/file_wish.h"
#include "engine/base/error.h"
#include "engine/camera/keyframes.h"
#include "engine/camera/path_edit.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

constexpr double kSmoothSeconds = 0.5;

void drawEdits(ViewSession& session, KeyframeEdit& edit) {
    const RecordedPath& path = session.paths().path();
    static double from = 0, to = 1;  // shares of the duration
    ImGui::SetNextItemWidth(-FLT_MIN);
    float ends[2] = {static_cast<float>(from), static_cast<float>(to)};
    if (ImGui::SliderFloat2("##ends", ends, 0, 1, "%.3f")) {
        from = std::min(ends[0], ends[1]);
        to = std::max(ends[0], ends[1]);
    }
    tooltip("Start and end of the part that Trim keeps, as shares of the duration.");
    if (button("Trim", "Keeps the part between start and end.")) {
        const double start = path.startTime(), duration = path.duration();
        session.paths().edit([=](const RecordedPath& all) {
            return trimmed(all, start + from * duration, start + to * duration);
        });
        from = 0;
        to = 1;
    }
    ImGui::SameLine();
    if (button("Smooth", "Removes shaking shorter than half a second; the ends stay."))
        session.paths().edit([](const RecordedPath& all) { return smoothed(all, kSmoothSeconds); });
    ImGui::SameLine();
    if (button("Even pace", "Flies the same path in the same time, at one speed."))
        session.paths().edit([](const RecordedPath& all) { return evenlyPaced(all, std::nullopt); });
    if (button("Undo##path", "Takes back the last change of the path.")) {
        if (edit.canUndo())
            edit.undo();
        else
            session.paths().undo();
    }
    ImGui::SameLine();
    if (button("Save", "Writes the path as flight_0001.gltf and so on.")) session.paths().save();
}

// Draws the height of the chosen keyframe over the ground, where there is ground.
void drawKeyframeHeight(KeyframeEdit& edit, const Flight& flight) {
    const Pose& pose = edit.keys()[*edit.chosen()].pose;
    const auto now = heightOverGround(flight, pose.position);
    if (!now) return;
    double height = *now;
    ImGui::SetNextItemWidth(-FLT_MIN);
    const float step = static_cast<float>(std::max(0.01 * std::abs(height), 0.1));
    const bool moved = ImGui::DragScalar("##height", ImGuiDataType_Double, &height, step, nullptr, nullptr,
                                         "%.1f m over the ground");
    if (ImGui::IsItemActivated()) edit.beginDrag(*edit.chosen());
    if (moved && edit.dragging()) edit.dragTo(pose.position + glm::dvec3(0, 0, std::max(height, 0.0) - *now));
    if (ImGui::IsItemDeactivated()) edit.endDrag();
    tooltip("Height of the chosen keyframe over the lowest place that the flight allows.");
}

void drawKeyframes(ViewSession& session, KeyframeEdit& edit, const Bookmarks* places) {
    const auto tried = [&](const auto& what) {
        try {
            what();
        } catch (const Error& error) {
            session.notify(error.what());
        }
    };
    const double speed = session.flight().speed();
    if (!edit.any()) {
        const bool path = session.paths().path().samples().size() > 1;
        if (button("Keyframes of the path",
                   "Turns the path into a few keyframes, which can be moved on the map (F3).", path))
            tried([&] { edit.start(keyframesToEdit(session.paths().path())); });
        if (places && places->list().size() > 1) {
            if (button("Fly through the places",
                       "Makes a smooth path through the kept places, in their order. Its keyframes can be "
                       "moved on the map (F3).")) {
                std::vector<Pose> poses;
                for (const Bookmark& place : places->list()) poses.push_back(place.pose);
                tried([&] { edit.start(timedKeyframes(poses, speed)); });
            }
        }
        if (button("Begin with this view", "Makes this view the first keyframe of a new path."))
            tried([&] { edit.add(session.pose(), speed); });
        return;
    }
    const std::size_t count = edit.keys().size();
    quietText(edit.chosen() ? fmt::format("keyframe {} of {}", *edit.chosen() + 1, count)
              : count == 1  ? "one keyframe: a path needs two"
                            : fmt::format("{} keyframes: drag them on the map (F3)", count));
    if (button("Add this view", "Adds a keyframe, after the chosen one or at the end."))
        tried([&] { edit.add(session.pose(), speed); });
    ImGui::SameLine();
    if (button("Remove", "Removes the chosen keyframe. Key: Del", edit.chosen().has_value()))
        edit.removeChosen();
    ImGui::SameLine();
    if (button("Done", "Ends the editing of keyframes; the path stays as it is.")) edit.start({});
    if (edit.chosen()) drawKeyframeHeight(edit, session.flight());
}

void drawMovie(const ViewSession& session, WindowJobs& jobs) {
    static MovieWish movie{"flight.mp4"};
    fileField("movie", "flight.mp4", movie.file);
    tooltip(
        "An .mp4 (H.264), an .mkv (lossless) or an .avi; or a folder, for pictures. Files that exist stay: "
        "the new one gets a number.");
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
    const bool busy = jobs.busy();
    if (button("Make movie", "Makes a movie of this path, in the mode that is shown. You can fly meanwhile.",
               !busy && !movie.file.empty() && session.paths().path().samples().size() > 1))
        jobs.makeMovie(movie);
}

}  // namespace

void drawPathPanel(ViewSession& session, KeyframeEdit& edit, const Bookmarks* places, WindowJobs& jobs,
                   AskedActions& actions) {
    if (button(session.paths().recording() ? "End recording" : "Record", "Key: z"))
        actions.ask({ViewCommand::Record});
    ImGui::SameLine();
    if (button(session.paths().playing() ? "Stop" : "Play", "Key: Shift+Z")) actions.ask({ViewCommand::Play});
    ImGui::SameLine();
    if (button("Home", "Key: Space")) actions.ask({ViewCommand::Home});
    ImGui::SameLine();
    if (button("Open...", "Opens a flight from a file, which replaces the path."))
        actions.ask({ViewCommand::OpenPath});
    const RecordedPath& path = session.paths().path();
    const bool any = path.samples().size() > 1;
    quietText(any ? fmt::format("A flight of {:.1f} s, {} places.", path.duration(), path.samples().size())
                  : "No flight yet: Record makes one.");
    if (any) drawEdits(session, edit);
    drawKeyframes(session, edit, places);
    drawMovie(session, jobs);
    bool byDistance = session.moves().speedByDistance();
    if (ImGui::Checkbox("speed by the distance ahead", &byDistance))
        actions.ask({ViewCommand::SpeedByDistance});
    tooltip(
        "The speed is set so that what is ahead, near or far, is reached in about four seconds; towards the "
        "sky it does not change. Key: Shift+F");
    quietText(fmt::format("speed {}/s: the wheel changes it, Shift is four times",
                          lengthText(session.moves().speed())));
}

}  // namespace stereonav
