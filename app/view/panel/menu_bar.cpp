#include "app/view/panel/menu_bar.h"

#include <imgui.h>

#include "app/view/panel/controls.h"
#include "engine/image/stereo_compose.h"
#include "engine/text/printable.h"

namespace stereonav {
namespace {

void item(PanelHost& host, const char* label, const char* key, ViewCommand command, bool checked = false) {
    if (ImGui::MenuItem(label, key, checked, host.session() != nullptr)) host.act({command});
}

void fileMenu(PanelHost& host, MenuWishes& wishes) {
    if (!ImGui::BeginMenu("File")) return;
    const bool shown = host.session() != nullptr;
    if (ImGui::MenuItem("Open...", "Ctrl+O")) wishes.openFile = true;
    if (wishes.other && ImGui::MenuItem("Open the other study...")) wishes.openOther = true;
    if (ImGui::MenuItem("Start page", "Ctrl+N")) wishes.start = true;
    ImGui::Separator();
    if (ImGui::MenuItem("Save scene...", "Ctrl+S", false, shown)) wishes.saveScene = true;
    item(host, "Save picture", "P", ViewCommand::Screenshot);
    if (ImGui::MenuItem("Save picture as...", nullptr, false, shown)) wishes.picture = true;
    if (ImGui::MenuItem("Copy command line", nullptr, false, shown))
        host.copy(commandLineOf(host.settingsToOpen()));
    tooltip("The command that opens the window as it is set now.");
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) host.quit();
    ImGui::EndMenu();
}

void editMenu(PanelHost& host) {
    if (!ImGui::BeginMenu("Edit")) return;
    if (ImGui::MenuItem("Undo", "Ctrl+Z", false, host.canUndo())) host.undo();
    if (ImGui::MenuItem("Redo", "Ctrl+Y", false, host.canRedo())) host.redo();
    item(host, "Reset view and stereo", "R", ViewCommand::Reset);
    ImGui::EndMenu();
}

void scaleMenu(PanelHost& host) {
    if (!ImGui::BeginMenu("Size of the interface")) return;
    for (const float scale : {0.75f, 1.0f, 1.25f, 1.5f, 1.75f, 2.0f}) {
        char label[16];
        snprintf(label, sizeof label, "%.0f %%", 100.0 * scale);
        InterfaceLook look = host.look();
        if (ImGui::MenuItem(label, nullptr, look.scale == scale)) {
            look.scale = scale;
            host.setLook(look);
        }
    }
    ImGui::EndMenu();
}

void viewMenu(PanelHost& host, MenuWishes& wishes) {
    if (!ImGui::BeginMenu("View")) return;
    ImGui::MenuItem("Panels", "F2", wishes.side);
    ImGui::MenuItem("Places, map and slices", "F3", wishes.left);
    if (wishes.unfolded) ImGui::MenuItem("Unfolded wall", "F10", wishes.unfolded);
    if (ImGui::MenuItem("Picture alone", "Tab")) wishes.hideAll = true;
    item(host, "Panels in their own window", "F7", ViewCommand::Controls, host.controlsApart());
    if (bool labels = host.placeLabels(); ImGui::MenuItem("Names of places", nullptr, &labels))
        host.showPlaceLabels(labels);
    tooltip("Of kept places that are in view, over the picture.");
    item(host, "Whole screen", "F11", ViewCommand::FullScreen, host.fullScreen());
    ImGui::Separator();
    InterfaceLook look = host.look();
    if (ImGui::MenuItem("Dark", nullptr, look.dark)) look.dark = true;
    if (ImGui::MenuItem("Light", nullptr, !look.dark)) look.dark = false;
    if (!(look == host.look())) host.setLook(look);
    scaleMenu(host);
    ImGui::EndMenu();
}

void modeItems(PanelHost& host, OutputLayout layout) {
    ViewSession* const session = host.session();
    for (const OutputModeInfo& mode : outputModes()) {
        if (mode.layout != layout) continue;
        const bool now = session && session->mode() == mode.mode;
        if (ImGui::MenuItem(std::string(mode.longName).c_str(), std::string(mode.shortName).c_str(), now,
                            session != nullptr))
            host.act({ViewCommand::SetMode, mode.mode});
    }
}

void stereoMenu(PanelHost& host) {
    if (!ImGui::BeginMenu("Stereo")) return;
    const ViewSession* const session = host.session();
    item(host, "Stereo", "3", ViewCommand::ToggleStereo, session && session->stereoOn());
    item(host, "Swap the eyes", "X", ViewCommand::SwapEyes, session && session->swapped());
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
        {OutputLayout::FrameSequential, "Shutter glasses, by turns"},
        {OutputLayout::QuadBuffer, "Shutter glasses, by the driver"}};
    for (const auto& [layout, name] : kLayouts)
        if (ImGui::BeginMenu(name)) {
            modeItems(host, layout);
            if (layout == OutputLayout::Anaglyph) {
                ImGui::Separator();
                item(host, "in linear light", "L", ViewCommand::LinearAnaglyph);
            }
            ImGui::EndMenu();
        }
    ImGui::EndMenu();
}

void flightMenu(PanelHost& host, MenuWishes& wishes) {
    if (!ImGui::BeginMenu("Flight")) return;
    ViewSession* const session = host.session();
    item(host, "Home", "Space", ViewCommand::Home);
    item(host, "Keep this place", "Ctrl+B", ViewCommand::AddPlace);
    ImGui::Separator();
    item(host, "Open a flight...", nullptr, ViewCommand::OpenPath);
    item(host, session && session->recording() ? "End recording" : "Record", "z", ViewCommand::Record);
    item(host, session && session->playing() ? "Stop playing" : "Play", "Shift+Z", ViewCommand::Play);
    if (ImGui::MenuItem("Make a movie...", nullptr, false, session != nullptr)) wishes.movie = true;
    ImGui::Separator();
    item(host, "Speed by the distance ahead", "Shift+F", ViewCommand::SpeedByDistance,
         session && session->speedByDistance());
    item(host, "Hold the mouse", "Y", ViewCommand::CaptureMouse, session && session->mouseCaptured());
    if (session) {
        ImGui::Separator();
        const Flight& flight = session->flight();
        for (int mode = 0; mode < flight.modeCount(); ++mode)
            if (ImGui::MenuItem(std::string(flight.modeName(mode)).c_str(), "F", mode == flight.mode()) &&
                mode != flight.mode())
                host.act({.command = ViewCommand::SetFlightMode, .number = mode});
        if (flight.lineMode())
            item(host, "Turn round, fly back", "Backspace", ViewCommand::TurnRound, flight.goesBack());
    }
    ImGui::EndMenu();
}

void toolsMenu(PanelHost& host, MenuWishes& wishes) {
    if (!ImGui::BeginMenu("Tools")) return;
    if (ImGui::MenuItem("Find anything...", "Ctrl+P")) wishes.search = true;
    ViewSession* const session = host.session();
    const bool sliced = session && session->open().scene->offered<SliceSource>();
    if (ImGui::MenuItem("Slices", "V", session && session->slicesShown(), sliced))
        host.act({ViewCommand::Slices});
    ImGui::EndMenu();
}

}  // namespace

float drawMenuBar(PanelHost& host, MenuWishes& wishes) {
    if (!ImGui::BeginMainMenuBar()) return 0;
    fileMenu(host, wishes);
    editMenu(host);
    viewMenu(host, wishes);
    stereoMenu(host);
    flightMenu(host, wishes);
    toolsMenu(host, wishes);
    if (ImGui::MenuItem("Help")) wishes.help = true;
    tooltip("All keys: F1");
    // What is open, where there is room for it.
    const std::string name = printable(host.settings().sceneName());
    const float width = ImGui::CalcTextSize(name.c_str()).x, left = ImGui::GetContentRegionAvail().x;
    if (const float margin = ImGui::GetFontSize(); width + 2 * margin < left) {
        ImGui::SameLine(ImGui::GetCursorPosX() + left - width - margin);
        ImGui::PushStyleColor(ImGuiCol_Text, quietColor(host.look()));
        ImGui::TextUnformatted(name.c_str());
        ImGui::PopStyleColor();
    }
    const float height = ImGui::GetWindowSize().y;
    ImGui::EndMainMenuBar();
    return height;
}

}  // namespace stereonav
