#include "app/view/panel/menu_bar.h"

#include <imgui.h>

#include <tuple>

#include "app/view/asked_actions.h"
#include "app/view/clipboard.h"
#include "app/view/flown_keyframes.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/second_panel.h"
#include "app/view/panel/unfolded_panel.h"
#include "app/view/second_side.h"
#include "app/view/window_jobs.h"
#include "engine/display/interface.h"
#include "engine/image/stereo_compose.h"
#include "engine/text/printable.h"

namespace stereonav {
namespace {

void item(const PanelParts& parts, const char* label, const char* key, ViewCommand command,
          bool checked = false) {
    if (ImGui::MenuItem(label, key, checked, parts.session != nullptr)) parts.actions.ask({command});
}

// Draws an entry for each command that makes a file of this scene alone.
void exportMenu(const PanelParts& parts, MenuWishes& wishes) {
    constexpr std::tuple<const char*, const char*, const char*> kExports[] = {
        {"mesh", "Ground as a mesh...", "ground.glb"},
        {"unfold", "Unfolded wall...", "unfolded.png"},
        {"centreline", "Line of the colon...", "line.vtp"}};
    if (!ImGui::BeginMenu("Export", parts.session != nullptr)) return;
    bool any = false;
    for (const auto& [command, label, name] : kExports) {
        if (!parts.jobs.exports(command)) continue;
        any = true;
        if (ImGui::MenuItem(label)) wishes.exports = command, wishes.exportName = name;
    }
    if (!any) quietLine("nothing of this scene");
    ImGui::EndMenu();
}

void fileMenu(const PanelParts& parts, ShownPanels& panels, MenuWishes& wishes) {
    if (!ImGui::BeginMenu("File")) return;
    const bool shown = parts.session != nullptr;
    if (ImGui::MenuItem("Open...", "Ctrl+O")) wishes.open = FileBrowser::For::Open;
    if (SecondPanel::has(parts.session) && ImGui::MenuItem("Open the other study..."))
        wishes.open = FileBrowser::For::OpenOther;
    if (ImGui::MenuItem("Start page", "Ctrl+N")) panels.start = true;
    ImGui::Separator();
    if (ImGui::MenuItem("Save scene...", "Ctrl+S", false, shown)) wishes.open = FileBrowser::For::SaveScene;
    item(parts, "Save picture", "P", ViewCommand::Screenshot);
    if (ImGui::MenuItem("Save picture as...", nullptr, false, shown)) wishes.picture = true;
    exportMenu(parts, wishes);
    if (ImGui::MenuItem("Copy command line", nullptr, false, shown))
        parts.clipboard.copy(commandLineOf(parts.second.settingsToOpen()));
    tooltip("Copies the command that opens the window as it is set now.");
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) parts.actions.ask({ViewCommand::Quit});
    ImGui::EndMenu();
}

void editMenu(const PanelParts& parts) {
    if (!ImGui::BeginMenu("Edit")) return;
    const KeyframeEdit& keyframes = parts.keyframes.edit();
    const SettingsHistory& settings = parts.changes.settings().history();
    const bool undo = parts.session && (keyframes.canUndo() || settings.canUndo());
    const bool redo = parts.session && (keyframes.canRedo() || settings.canRedo());
    if (ImGui::MenuItem("Undo", "Ctrl+Z", false, undo)) parts.actions.ask({ViewCommand::Undo});
    if (ImGui::MenuItem("Redo", "Ctrl+Y", false, redo)) parts.actions.ask({ViewCommand::Redo});
    item(parts, "Reset view and stereo", "R", ViewCommand::Reset);
    ImGui::EndMenu();
}

void scaleMenu(const PanelParts& parts) {
    if (!ImGui::BeginMenu("Size of the interface")) return;
    for (const float scale : {0.75f, 1.0f, 1.25f, 1.5f, 1.75f, 2.0f}) {
        char label[16];
        snprintf(label, sizeof label, "%.0f %%", 100.0 * scale);
        InterfaceLook look = parts.interface.look();
        if (ImGui::MenuItem(label, nullptr, look.scale == scale)) {
            look.scale = scale;
            parts.interface.setLook(look);
        }
    }
    ImGui::EndMenu();
}

void viewMenu(const PanelParts& parts, ShownPanels& panels) {
    if (!ImGui::BeginMenu("View")) return;
    ImGui::MenuItem("Panels", "F2", &panels.side.shown);
    ImGui::MenuItem("Places, map and slices", "F3", &panels.left.shown);
    if (UnfoldedPanel::has(parts.session)) ImGui::MenuItem("Unfolded wall", "F10", &panels.unfolded);
    if (ImGui::MenuItem("Picture alone", "Tab")) panels.hidden = true;
    item(parts, "Panels in their own window", "F7", ViewCommand::Controls, parts.ownWindow);
    ImGui::MenuItem("Names of places", nullptr, &panels.placeNames);
    tooltip("Shows the names of kept places that are in view, over the picture.");
    ImGui::MenuItem("Figures", nullptr, &panels.figures);
    tooltip("Shows times, ages and errors in the line at the bottom, in place of words.");
    item(parts, "Whole screen", "F11", ViewCommand::FullScreen, parts.display.fullScreen());
    ImGui::Separator();
    InterfaceLook look = parts.interface.look();
    if (ImGui::MenuItem("Dark", nullptr, look.dark)) look.dark = true;
    if (ImGui::MenuItem("Light", nullptr, !look.dark)) look.dark = false;
    if (!(look == parts.interface.look())) parts.interface.setLook(look);
    scaleMenu(parts);
    ImGui::EndMenu();
}

void modeItems(const PanelParts& parts, OutputLayout layout) {
    ViewSession* const session = parts.session;
    for (const OutputModeInfo& mode : outputModes()) {
        if (mode.layout != layout) continue;
        const bool now = session && session->mode() == mode.mode;
        if (ImGui::MenuItem(std::string(mode.longName).c_str(), std::string(mode.shortName).c_str(), now,
                            session != nullptr))
            parts.actions.ask({ViewCommand::SetMode, mode.mode});
    }
}

void stereoMenu(const PanelParts& parts) {
    if (!ImGui::BeginMenu("Stereo")) return;
    const ViewSession* const session = parts.session;
    item(parts, "Stereo", "3", ViewCommand::ToggleStereo, session && session->stereoOn());
    item(parts, "Swap the eyes", "X", ViewCommand::SwapEyes, session && session->swapped());
    ImGui::Separator();
    constexpr std::pair<OutputLayout, const char*> kLayouts[] = {
        {OutputLayout::OneEye, "One eye"},
        {OutputLayout::SideBySide, "Side by side"},
        {OutputLayout::TopBottom, "Top and bottom"},
        {OutputLayout::Rows, "Rows"},
        {OutputLayout::Columns, "Columns"},
        {OutputLayout::Checkerboard, "Checkerboard"},
        {OutputLayout::Anaglyph, "Coloured glasses"},
        {OutputLayout::FramePacked, "Frame-packed"},
        {OutputLayout::FrameSequential, "Shutter glasses, alternating"},
        {OutputLayout::QuadBuffer, "Shutter glasses, by the driver"}};
    for (const auto& [layout, name] : kLayouts)
        if (ImGui::BeginMenu(name)) {
            modeItems(parts, layout);
            if (layout == OutputLayout::Anaglyph) {
                ImGui::Separator();
                item(parts, "in linear light", "L", ViewCommand::LinearAnaglyph);
            }
            ImGui::EndMenu();
        }
    ImGui::EndMenu();
}

void flightMenu(const PanelParts& parts, MenuWishes& wishes) {
    if (!ImGui::BeginMenu("Flight")) return;
    ViewSession* const session = parts.session;
    item(parts, "Home", "Space", ViewCommand::Home);
    if (ImGui::MenuItem("Go to a place...", "Ctrl+G", false, session != nullptr)) wishes.place = true;
    tooltip("By its coordinates, or a length along a colon's line.");
    item(parts, "Keep this place", "Ctrl+B", ViewCommand::AddPlace);
    ImGui::Separator();
    item(parts, "Open a flight...", nullptr, ViewCommand::OpenPath);
    item(parts, session && session->paths().recording() ? "End recording" : "Record", "z",
         ViewCommand::Record);
    item(parts, session && session->paths().playing() ? "Stop playing" : "Play", "Shift+Z",
         ViewCommand::Play);
    if (ImGui::MenuItem("Make a movie...", nullptr, false, session != nullptr)) wishes.movie = true;
    ImGui::Separator();
    item(parts, "Orbit: turn, pan and zoom by mouse", "Ctrl+R", ViewCommand::ToggleOrbit,
         session && session->orbits());
    tooltip(
        "Left drag turns about what is under the pointer, Shift or the middle button pans, the wheel and the "
        "right button zoom. Otherwise dragging looks around, and the wheel sets the speed.");
    item(parts, "Speed by the distance ahead", "Shift+F", ViewCommand::SpeedByDistance,
         session && session->moves().speedByDistance());
    item(parts, "Hold the mouse", "Y", ViewCommand::CaptureMouse, session && session->mouseCaptured());
    if (session) {
        ImGui::Separator();
        const Flight& flight = session->flight();
        for (int mode = 0; mode < flight.modeCount(); ++mode)
            if (ImGui::MenuItem(std::string(flight.modeName(mode)).c_str(), "F", mode == flight.mode()) &&
                mode != flight.mode())
                parts.actions.ask({.command = ViewCommand::SetFlightMode, .number = mode});
        if (flight.lineMode())
            item(parts, "Turn round, fly back", "Backspace", ViewCommand::TurnRound, flight.goesBack());
    }
    ImGui::EndMenu();
}

void toolsMenu(const PanelParts& parts, MenuWishes& wishes) {
    if (!ImGui::BeginMenu("Tools")) return;
    if (ImGui::MenuItem("Find anything...", "Ctrl+P")) wishes.search = true;
    ViewSession* const session = parts.session;
    const bool sliced = session && session->open().scene->offered<SliceSource>();
    if (ImGui::MenuItem("Slices", "V", session && session->slices().shown(), sliced))
        parts.actions.ask({ViewCommand::Slices});
    ImGui::EndMenu();
}

}  // namespace

float drawMenuBar(const PanelParts& parts, ShownPanels& shown, MenuWishes& wishes) {
    if (!ImGui::BeginMainMenuBar()) return 0;
    fileMenu(parts, shown, wishes);
    editMenu(parts);
    viewMenu(parts, shown);
    stereoMenu(parts);
    flightMenu(parts, wishes);
    toolsMenu(parts, wishes);
    if (ImGui::MenuItem("Help")) shown.help = true;
    tooltip("All keys: F1");
    // The name of the open scene, where there is room.
    const std::string name = printable(parts.changes.settings().sceneName());
    const float width = ImGui::CalcTextSize(name.c_str()).x, left = ImGui::GetContentRegionAvail().x;
    if (const float margin = ImGui::GetFontSize(); width + 2 * margin < left) {
        ImGui::SameLine(ImGui::GetCursorPosX() + left - width - margin);
        ImGui::PushStyleColor(ImGuiCol_Text, quietNow());
        ImGui::TextUnformatted(name.c_str());
        ImGui::PopStyleColor();
    }
    const float height = ImGui::GetWindowSize().y;
    ImGui::EndMainMenuBar();
    return height;
}

}  // namespace stereonav
