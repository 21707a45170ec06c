#include "app/view/panel/side_panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "app/view/clipboard.h"
#include "app/view/flown_keyframes.h"
#include "app/view/frame_presenter.h"
#include "app/view/kept_places.h"
#include "app/view/panel/comfort_meter.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/file_wish.h"
#include "app/view/panel/ground_paint_panel.h"
#include "app/view/panel/legend.h"
#include "app/view/panel/path_panel.h"
#include "app/view/panel/screen_lines.h"
#include "app/view/scene_facts.h"
#include "app/view/second_side.h"
#include "app/view/status.h"
#include "engine/display/interface.h"

namespace stereonav {
namespace {

std::vector<const Option*> optionsOf(const SceneChanges& changes, OptionPanel panel) {
    std::vector<const Option*> options;
    for (const Option& option : optionTable())
        if ((option.commands & command::kView) && option.panel == panel && changes.settings().applies(option))
            options.push_back(&option);
    return options;
}

void drawOptions(SceneChanges& changes, OptionPanel panel) {
    for (const Option* const option : optionsOf(changes, panel)) optionControl(changes, *option);
}

void command(AskedActions& actions, const char* label, ViewCommand which, const char* tip) {
    if (button(label, tip)) actions.ask({which});
}

void drawView(const PanelParts& parts, ViewSession& session) {
    drawOptions(parts.changes, OptionPanel::View);
    drawScreen(parts);
    bool stereo = session.stereoOn(), swapped = session.swapped();
    if (ImGui::Checkbox("stereo", &stereo)) parts.actions.ask({ViewCommand::ToggleStereo});
    tooltip("Shows two eyes, or one. Key: 3");
    ImGui::SameLine();
    if (ImGui::Checkbox("swap eyes", &swapped)) parts.actions.ask({ViewCommand::SwapEyes});
    tooltip("Swaps the eyes, for when depth looks inverted. Key: X");
    if (session.open().scene->offered<RoomAround>()) {
        bool follows = session.followsClearance();
        if (ImGui::Checkbox("eyes follow the room", &follows) && follows)
            parts.actions.ask({ViewCommand::FollowClearance});
        tooltip(
            "The distance between the eyes follows the room around them; setting it by hand ends this. Key: "
            "C");
    }
    bool clamps = session.eyes().clamp();
    if (ImGui::Checkbox("keep comfortable", &clamps)) session.eyes().setClamp(clamps);
    tooltip("Brings the eyes together, slowly, while the picture's parallax is more than is comfortable.");
    const ViewFrame* const frame = parts.pictures.frame();
    if (!frame || !frame->request.twoEyes) return;
    drawComfortMeter(parts.display, *frame);
    const ScreenWords onScreen = parts.display.wordsOf(*frame);
    const std::string warning = onScreen.warning.empty() ? warningLine(*frame) : onScreen.warning;
    if (!onScreen.parallax.empty()) quietText(onScreen.parallax);
    quietText(warning.empty() ? fmt::format("parallax {:+.1f} to {:+.1f} % of the width",
                                            100 * frame->nearParallax, 100 * frame->farParallax)
                              : warning);
}

// Draws controls for `bake`, for scenes whose light it can bake.
void drawBake(WindowJobs& jobs) {
    const Option* const light = viewOption("light");
    const Option* const what = findOption(command::kBake, "what");
    if (!light || !what || !jobs.bakes()) return;
    static int chosen = 1;
    static double minutes = 2;
    const std::vector<std::string>& words = what->value.words;
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##what", words[static_cast<std::size_t>(chosen)].c_str())) {
        for (std::size_t n = 0; n < words.size(); ++n)
            if (jobs.bakeTakes("what", words[n]) && ImGui::Selectable(words[n].c_str()))
                chosen = static_cast<int>(n);
        ImGui::EndCombo();
    }
    tooltip(what->help);
    ImGui::SameLine();
    if (jobs.bakeTakes("minutes", "1")) {
        ImGui::SetNextItemWidth(5 * ImGui::GetFontSize());
        ImGui::DragScalar("##minutes", ImGuiDataType_Double, &minutes, 0.05f, nullptr, nullptr, "%.1f min");
        minutes = std::clamp(minutes, 0.1, 600.0);
        tooltip("The bake takes this long, or less if it is complete before.");
        ImGui::SameLine();
    }
    const bool busy = jobs.busy();
    if (button("Bake",
               "Computes light with shadows and reflections, and then shows it. You can fly meanwhile.",
               !busy))
        jobs.bakeLight(words[static_cast<std::size_t>(chosen)], minutes);
}

void drawLight(SceneChanges& changes, WindowJobs& jobs, ViewSession& session, SunPanel& sun) {
    if (SunPanel::has(changes)) sun.draw(changes, session);
    drawOptions(changes, OptionPanel::Light);
    drawBake(jobs);
    const std::string why = session.open().scene->whyLightStays();
    if (session.open().scene->offered<TurningLight>())
        quietText("U H J K, or a gamepad's cross, move the light.");
    else if (!why.empty())
        quietText("The light stands still: " + why + ".");
}

void drawMaterial(const PanelParts& parts, ViewSession& session, TransferPanel& transfer) {
    const Scene& scene = *session.open().scene;
    if (TransferPanel::has(scene)) transfer.draw(parts.changes, session, parts.interface.look().grey);
    drawOptions(parts.changes, OptionPanel::Material);
    drawGroundPaint(parts.changes, parts.instruments, session);
    drawLegend(scene);
    const auto* const surface = scene.offered<SurfaceChoices>();
    if (!surface) return;
    bool translucent = *session.surface().now().translucent;
    if (ImGui::Checkbox("translucent", &translucent)) parts.actions.ask({ViewCommand::ToggleTranslucent});
    tooltip("Shows the volume translucent, by the transfer function, or as an opaque surface. Key: T");
    ImGui::SameLine();
    command(parts.actions, "Next function", ViewCommand::NextTransfer, "Key: Shift+T");
    if (!session.surface().now().ambient) return;
    command(parts.actions, "Ambient light", ViewCommand::NextAmbient,
            "The next method of ambient light, or none. Key: O");
    ImGui::SameLine();
    command(parts.actions, "Modulate", ViewCommand::NextModulation,
            "Opacity by variance, by gradient, or unchanged. Key: B");
}

// Plots one quantity over the last frames, with its newest value.
void plot(const FramePresenter& pictures, const char* label, double FrameCost::*what, const char* unit) {
    std::array<float, 120> values{};
    const auto& costs = pictures.costs();
    const std::size_t count = std::min(values.size(), costs.size());
    for (std::size_t n = 0; n < count; ++n)
        values[n] = static_cast<float>(costs[costs.size() - count + n].*what);
    const float most =
        count ? *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)) : 0;
    if (!(most > 0)) return;
    const std::string text = fmt::format("{} {:.1f} {}", label, values[count - 1], unit);
    ImGui::PushID(label);
    ImGui::PlotLines("##plot", values.data(), static_cast<int>(count), 0, text.c_str(), 0, 1.2f * most,
                     {-FLT_MIN, 2.2f * ImGui::GetFontSize()});
    ImGui::PopID();
    tooltip(fmt::format("{}, {}: the last {} frames, up to {:.1f}", label, unit, count, most));
}

// Draws the choice of what the right eye shows, and its error.
void drawTruth(ViewSession& session, const ViewFrame* frame) {
    constexpr std::tuple<TruthView, const char*, const char*> kViews[] = {
        {TruthView::None, "as made", "The right eye as it is made."},
        {TruthView::FullCast, "full", "The right eye cast in full. Key: F4"},
        {TruthView::Difference, "x5",
         "Five times its difference from a full cast; black: no difference. Key: F5"},
        {TruthView::Holes, "holes",
         "Red: pixels that were cast because the left eye does not see them. Key: F6"}};
    quietLine("right eye");
    for (const auto& [view, label, tip] : kViews) {
        if (view != TruthView::None) ImGui::SameLine();
        if (ImGui::RadioButton(label, session.truth() == view)) session.setTruth(view);
        tooltip(tip);
    }
    if (!frame) return;
    if (!frame->truthNote.empty()) quietText(frame->truthNote);
    if (const std::string measured = session.measuredText(*frame); !measured.empty()) quietText(measured);
}

void drawQuality(SceneChanges& changes, const FramePresenter& pictures, ViewSession& session) {
    drawOptions(changes, OptionPanel::Quality);
    drawTruth(session, pictures.frame());
    plot(pictures, "left", &FrameCost::left_ms, "ms");
    plot(pictures, "right", &FrameCost::right_ms, "ms");
    plot(pictures, "warp", &FrameCost::warp_ms, "ms");
    plot(pictures, "fill", &FrameCost::fill_ms, "ms");
    plot(pictures, "holes", &FrameCost::holes, "%");
    if (const ViewFrame* const frame = pictures.frame())
        quietText(frameText(*frame, pictures.framesPerSecond()));
}

void drawFacts(const Facts* facts) {
    if (!facts) return quietText("being collected");
    factTable("facts", *facts);
}

// Draws controls that save the view as a picture, in any size and format.
void drawPicture(WindowJobs& jobs, const SizeOption& shown) {
    static PictureWish picture{"view.png"};
    fileField("picture", "view.png", picture.file);
    tooltip(
        "A .png in the mode that is shown, or a .jps or .mpo of both eyes for 3D viewers. Files that exist "
        "stay: the new one gets a number.");
    static double times = 1;
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    ImGui::DragScalar("##times", ImGuiDataType_Double, &times, 0.02f, nullptr, nullptr, "%.2f times");
    times = std::clamp(times, 0.1, 16.0);
    tooltip("Size, as a factor on the picture that is shown.");
    picture.width = static_cast<int>(std::lround(times * shown.width));
    picture.height = static_cast<int>(std::lround(times * shown.height));
    ImGui::SameLine();
    const bool busy = jobs.busy();
    if (button("Save picture",
               "Saves what is seen now; both eyes are cast in full, unless a method is set. You can fly "
               "meanwhile.",
               !busy && !picture.file.empty()))
        jobs.savePicture(picture);
    quietText(fmt::format("{} x {} pixels an eye", picture.width, picture.height));
}

bool heading(const char* label, bool open) {
    return ImGui::CollapsingHeader(label, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

}  // namespace

void drawSidePanels(const PanelParts& parts, SideTools& tools) {
    ViewSession* const session = parts.session;
    if (!session) return quietText("nothing is open yet");
    SceneChanges& changes = parts.changes;
    const auto any = [&](OptionPanel panel) { return !optionsOf(changes, panel).empty(); };
    if (heading("View and stereo", true)) drawView(parts, *session);
    if (any(OptionPanel::Light) && heading("Light", true))
        drawLight(changes, parts.jobs, *session, tools.sun);
    if (any(OptionPanel::Material) && heading("Material", false))
        drawMaterial(parts, *session, tools.transfer);
    if (any(OptionPanel::Medium) && heading("Medium", false)) drawOptions(changes, OptionPanel::Medium);
    if (tools.showPath) ImGui::SetNextItemOpen(true);
    const bool path = heading("Flight and path", false);
    if (std::exchange(tools.showPath, false)) ImGui::SetScrollHereY(0);
    if (path) drawPathPanel(*session, parts.keyframes.edit(), parts.kept.places(), parts.jobs, parts.actions);
    if (tools.showPicture) ImGui::SetNextItemOpen(true);
    const bool picture = heading("Picture", false);
    if (std::exchange(tools.showPicture, false)) ImGui::SetScrollHereY(0);
    if (picture) drawPicture(parts.jobs, parts.eyeSize);
    if (heading("Quality and cost", false)) drawQuality(changes, parts.pictures, *session);
    if (any(OptionPanel::Study) && heading("Study", false)) drawOptions(changes, OptionPanel::Study);
    if (heading("Scene", false)) drawFacts(parts.facts.of(changes.worker()));
    if (heading("Command line", false)) {
        quietText(commandLineOf(parts.second.settingsToOpen()));
        if (button("Copy##view", "Copies the command that opens the window as it is set now."))
            parts.clipboard.copy(commandLineOf(parts.second.settingsToOpen()));
        ImGui::SameLine();
        const std::string at = poseText(session->pose());
        if (button("Copy for a picture", "Copies the command that writes what is seen now into view.png."))
            parts.clipboard.copy(renderLineOf(
                withEyes(changes.settings().now(), session->stereo(), !session->shownMode().stereo), at,
                parts.eyeSize));
    }
}

}  // namespace stereonav
