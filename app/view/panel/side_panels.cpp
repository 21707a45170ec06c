#include "app/view/panel/side_panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "app/view/panel/comfort_meter.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/ground_paint_panel.h"
#include "app/view/panel/legend.h"
#include "app/view/panel/path_panel.h"
#include "app/view/status.h"

namespace stereonav {
namespace {

std::vector<const Option*> optionsOf(PanelHost& host, OptionPanel panel) {
    std::vector<const Option*> options;
    for (const Option& option : optionTable())
        if ((option.commands & command::kView) && option.panel == panel && host.settings().applies(option))
            options.push_back(&option);
    return options;
}

void command(PanelHost& host, const char* label, ViewCommand which, const char* tip) {
    if (ImGui::Button(label)) host.act({which});
    tooltip(tip);
}

void drawView(PanelHost& host, ViewSession& session) {
    for (const Option* const option : optionsOf(host, OptionPanel::View)) optionControl(host, *option);
    quietText(host, host.screen().words);
    tooltip("Parallax in millimetres and degrees is by this. It is kept for this monitor.");
    bool stereo = session.stereoOn(), swapped = session.swapped();
    if (ImGui::Checkbox("stereo", &stereo)) host.act({ViewCommand::ToggleStereo});
    tooltip("Two eyes, or one. Key: 3");
    ImGui::SameLine();
    if (ImGui::Checkbox("swap eyes", &swapped)) host.act({ViewCommand::SwapEyes});
    tooltip("Where depth is inverted. Key: X");
    if (session.open().scene->offered<RoomAround>()) {
        bool follows = session.followsClearance();
        if (ImGui::Checkbox("eyes follow the room", &follows) && follows)
            host.act({ViewCommand::FollowClearance});
        tooltip("As far apart as the room around them suits; setting them by hand ends it. Key: C");
    }
    bool clamps = session.eyes().clamp();
    if (ImGui::Checkbox("keep comfortable", &clamps)) session.eyes().setClamp(clamps);
    tooltip("Brings the eyes together, slowly, while the picture's parallax is more than is comfortable.");
    const ViewFrame* const frame = host.frame();
    if (!frame || !frame->request.twoEyes) return;
    drawComfortMeter(host, *frame);
    const ScreenWords onScreen = host.onScreen(*frame);
    const std::string warning = onScreen.warning.empty() ? warningLine(*frame) : onScreen.warning;
    if (!onScreen.parallax.empty()) quietText(host, onScreen.parallax);
    quietText(host, warning.empty() ? fmt::format("parallax {:+.1f} to {:+.1f} % of the width",
                                                  100 * frame->nearParallax, 100 * frame->farParallax)
                                    : warning);
}

void drawOptions(PanelHost& host, OptionPanel panel) {
    for (const Option* const option : optionsOf(host, panel)) optionControl(host, *option);
}

// Of scenes whose light can be baked: those that `bake` takes.
void drawBake(PanelHost& host, ViewSession&) {
    const Option* const light = viewOption("light");
    const Option* const what = findOption(command::kBake, "what");
    if (!light || !what || !host.jobs().bakes()) return;
    static int chosen = 1;
    static double minutes = 2;
    const std::vector<std::string>& words = what->value.words;
    ImGui::SetNextItemWidth(7 * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##what", words[static_cast<std::size_t>(chosen)].c_str())) {
        for (std::size_t n = 0; n < words.size(); ++n)
            if (host.jobs().bakeTakes("what", words[n]) && ImGui::Selectable(words[n].c_str()))
                chosen = static_cast<int>(n);
        ImGui::EndCombo();
    }
    tooltip(what->help);
    ImGui::SameLine();
    if (host.jobs().bakeTakes("minutes", "1")) {
        ImGui::SetNextItemWidth(5 * ImGui::GetFontSize());
        ImGui::DragScalar("##minutes", ImGuiDataType_Double, &minutes, 0.05f, nullptr, nullptr, "%.1f min");
        minutes = std::clamp(minutes, 0.1, 600.0);
        tooltip("It takes this long, or less where all is done before.");
        ImGui::SameLine();
    }
    const bool busy = host.jobs().busy();
    ImGui::BeginDisabled(busy);
    if (ImGui::Button("Bake")) host.jobs().bakeLight(words[static_cast<std::size_t>(chosen)], minutes);
    ImGui::EndDisabled();
    tooltip(
        "Computes light with its shadows and reflections beforehand, and shows it. It goes on beside the "
        "flight.");
}

void drawLight(PanelHost& host, ViewSession& session, SunPanel& sun) {
    if (SunPanel::has(host)) sun.draw(host);
    drawOptions(host, OptionPanel::Light);
    drawBake(host, session);
    const std::string why = session.open().scene->whyLightStays();
    if (session.open().scene->offered<TurningLight>())
        quietText(host, "U H J K, or the cross of a gamepad, move the light.");
    else if (!why.empty())
        quietText(host, "The light stands still: " + why + ".");
}

void drawMaterial(PanelHost& host, ViewSession& session, TransferPanel& transfer) {
    if (TransferPanel::has(host)) transfer.draw(host);
    drawOptions(host, OptionPanel::Material);
    drawGroundPaint(host, *session.open().scene);
    drawLegend(host, *session.open().scene);
    const auto* const surface = session.open().scene->offered<SurfaceChoices>();
    if (!surface) return;
    bool translucent = *session.surface().translucent;
    if (ImGui::Checkbox("translucent", &translucent)) host.act({ViewCommand::ToggleTranslucent});
    tooltip("Seen through, by the transfer function, or an opaque surface. Key: T");
    ImGui::SameLine();
    command(host, "Next function", ViewCommand::NextTransfer, "Key: Shift+T");
    if (!session.surface().ambient) return;
    command(host, "Ambient light", ViewCommand::NextAmbient,
            "The next method of ambient light, or none. Key: O");
    ImGui::SameLine();
    command(host, "Modulate", ViewCommand::NextModulation,
            "Opacity by variance, by gradient, as it is. Key: B");
}

// One quantity over the last frames, with its newest value.
void plot(PanelHost& host, const char* label, double FrameCost::*what, const char* unit) {
    std::array<float, 120> values{};
    const auto& costs = host.pictures().costs();
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

// What the right eye shows, and how far it is from the truth.
void drawTruth(PanelHost& host, ViewSession& session) {
    constexpr std::tuple<TruthView, const char*, const char*> kViews[] = {
        {TruthView::None, "as made", "The right eye as it is made."},
        {TruthView::FullCast, "full", "The right eye cast in full. Key: F4"},
        {TruthView::Difference, "x5", "Five times its difference from a full cast; black: none. Key: F5"},
        {TruthView::Holes, "holes", "What was cast, since the left eye did not see it, in red. Key: F6"}};
    quietLine(host, "right eye");
    for (const auto& [view, label, tip] : kViews) {
        if (view != TruthView::None) ImGui::SameLine();
        if (ImGui::RadioButton(label, session.truth() == view)) session.setTruth(view);
        tooltip(tip);
    }
    if (const ViewFrame* const frame = host.frame(); frame && !frame->truthNote.empty())
        quietText(host, frame->truthNote);
    if (const ViewFrame* const frame = host.frame())
        if (const std::string measured = session.measuredText(*frame); !measured.empty())
            quietText(host, measured);
}

void drawQuality(PanelHost& host, ViewSession& session) {
    drawOptions(host, OptionPanel::Quality);
    drawTruth(host, session);
    plot(host, "left", &FrameCost::left_ms, "ms");
    plot(host, "right", &FrameCost::right_ms, "ms");
    plot(host, "warp", &FrameCost::warp_ms, "ms");
    plot(host, "fill", &FrameCost::fill_ms, "ms");
    plot(host, "holes", &FrameCost::holes, "%");
    if (const ViewFrame* const frame = host.frame())
        quietText(host, frameText(*frame, host.pictures().framesPerSecond()));
}

void drawFacts(PanelHost& host) {
    const Facts* const facts = host.facts();
    if (!facts) return quietText(host, "being collected");
    factTable(host, "facts", *facts);
}

// Of what is seen, in any size and kind of file.
void drawPicture(PanelHost& host) {
    static PictureWish picture{"view.png"};
    const SizeOption shown = host.pictureSize();
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##picture", "view.png", &picture.file);
    tooltip(
        "A .png of the mode that is shown, or of both eyes for 3D viewers: a .jps or an .mpo. What is there "
        "already stays: the new one gets a number.");
    static double times = 1;
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    ImGui::DragScalar("##times", ImGuiDataType_Double, &times, 0.02f, nullptr, nullptr, "%.2f times");
    times = std::clamp(times, 0.1, 16.0);
    tooltip("As large as the picture that is shown.");
    picture.width = static_cast<int>(std::lround(times * shown.width));
    picture.height = static_cast<int>(std::lround(times * shown.height));
    ImGui::SameLine();
    const bool busy = host.jobs().busy();
    ImGui::BeginDisabled(busy || picture.file.empty());
    if (ImGui::Button("Save picture")) host.jobs().savePicture(picture);
    ImGui::EndDisabled();
    tooltip(
        "Of what is seen now; both eyes are made in full, unless a method is set. It goes on beside the "
        "flight.");
    quietText(host, fmt::format("{} x {} pixels an eye", picture.width, picture.height));
}

bool heading(const char* label, bool open) {
    return ImGui::CollapsingHeader(label, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

}  // namespace

void drawSidePanels(PanelHost& host, SideTools& tools) {
    ViewSession* const session = host.session();
    if (!session) return quietText(host, "nothing is open yet");
    const auto any = [&](OptionPanel panel) { return !optionsOf(host, panel).empty(); };
    if (heading("View and stereo", true)) drawView(host, *session);
    if (any(OptionPanel::Light) && heading("Light", true)) drawLight(host, *session, tools.sun);
    if (any(OptionPanel::Material) && heading("Material", false))
        drawMaterial(host, *session, tools.transfer);
    if (any(OptionPanel::Medium) && heading("Medium", false)) drawOptions(host, OptionPanel::Medium);
    if (tools.showPath) ImGui::SetNextItemOpen(true);
    const bool path = heading("Flight and path", false);
    if (std::exchange(tools.showPath, false)) ImGui::SetScrollHereY(0);
    if (path) drawPathPanel(host, *session);
    if (tools.showPicture) ImGui::SetNextItemOpen(true);
    const bool picture = heading("Picture", false);
    if (std::exchange(tools.showPicture, false)) ImGui::SetScrollHereY(0);
    if (picture) drawPicture(host);
    if (heading("Quality and cost", false)) drawQuality(host, *session);
    if (any(OptionPanel::Study) && heading("Study", false)) drawOptions(host, OptionPanel::Study);
    if (heading("Scene", false)) drawFacts(host);
    if (heading("Command line", false)) {
        quietText(host, commandLineOf(host.settingsToOpen()));
        if (ImGui::Button("Copy##view")) host.copy(commandLineOf(host.settingsToOpen()));
        tooltip("Opens the window as it is set now.");
        ImGui::SameLine();
        const std::string at = poseText(session->pose());
        if (ImGui::Button("Copy for a picture"))
            host.copy(
                renderLineOf(withEyes(host.settings().now(), session->stereo()), at, host.pictureSize()));
        tooltip("Writes what is seen now into view.png, as it is set now.");
    }
}

}  // namespace stereonav
