#include "app/view/panel/panels.h"

#include <imgui.h>

#include <algorithm>

#include "app/view/input.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/file_browser.h"
#include "app/view/panel/menu_bar.h"
#include "app/view/panel/search.h"
#include "app/view/panel/side_panels.h"
#include "app/view/panel/start_page.h"
#include "app/view/panel/status_bar.h"

namespace stereonav {
namespace {

// In letters' heights.
constexpr float kSideWidth = 22, kNarrowest = 14;
constexpr float kBeside = 56;  // as wide must the interface be for panels beside the picture
constexpr ImGuiWindowFlags kPlainBox = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;

}  // namespace

struct Panels::State {
    bool hidden = false, side = false, help = false;
    float sideWidth = kSideWidth;  // letters' heights
    bool beside = true;            // panels take their room from the picture
    float sideTaken = 0;           // units, at the right
    SearchBox search;
    FileBrowser files;
    StartPage start;

    void drawHelp(PanelHost& host);
    void drawSide(PanelHost& host, float top);
};

Panels::Panels() : mState(std::make_unique<State>()) {}
Panels::~Panels() = default;

void Panels::State::drawHelp(PanelHost& host) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({whole.x / 2, whole.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(whole.x - font, 64 * font), std::min(whole.y - 3 * font, 40 * font)});
    ImGui::Begin("Keys", &help,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings);
    const int columns = ImGui::GetContentRegionAvail().x > 58 * font ? 2 : 1;
    if (ImGui::BeginTable("keys", 2 * columns,
                          ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_PreciseWidths)) {
        const auto& keys = viewKeys();
        const std::size_t rows =
            (keys.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
        for (std::size_t row = 0; row < rows; ++row) {
            ImGui::TableNextRow();
            for (std::size_t n = row; n < keys.size(); n += rows) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(keys[n].keys.c_str());
                ImGui::TableNextColumn();
                quietLine(host, keys[n].meaning + "   ");
            }
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void Panels::State::drawSide(PanelHost& host, float top) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    const float most = std::max(whole.x - 8 * font, 4 * font);
    const float width = std::min(sideWidth * font, most);
    ImGui::SetNextWindowPos({whole.x - width, top});
    ImGui::SetNextWindowSize({width, std::max(whole.y - top, 1.0f)});
    ImGui::Begin("##side", nullptr, kPlainBox & ~ImGuiWindowFlags_NoScrollbar);
    drawSidePanels(host);
    ImGui::End();
    sideTaken = width;
    // Its left border is dragged.
    ImGui::SetNextWindowPos({whole.x - width - 0.25f * font, top});
    ImGui::SetNextWindowSize({0.5f * font, std::max(whole.y - top, 1.0f)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##border", nullptr, kPlainBox | ImGuiWindowFlags_NoBackground);
    ImGui::InvisibleButton("##grip", {0.5f * font, std::max(whole.y - top, 1.0f)});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive())
        sideWidth = std::clamp(sideWidth - ImGui::GetIO().MouseDelta.x / font, kNarrowest, most / font);
    ImGui::End();
    ImGui::PopStyleVar();
}

void Panels::draw(PanelHost& host) {
    State& state = *mState;
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    state.sideTaken = 0;
    state.beside = whole.x >= kBeside * ImGui::GetFontSize();
    float top = 0, bottom = 0;
    if (!state.hidden) {
        MenuWishes wishes;
        wishes.side = &state.side;
        top = drawMenuBar(host, wishes);
        if (wishes.openFile) state.files.open(FileBrowser::For::Open);
        if (wishes.saveScene) state.files.open(FileBrowser::For::SaveScene);
        if (wishes.start) state.start.show(true);
        if (wishes.search) state.search.open();
        if (wishes.help) state.help = true;
        if (wishes.hideAll) state.hidden = true;
        if (state.side) state.drawSide(host, top);
        bottom = drawStatusBar(host, 0, state.sideTaken);
    }
    (void)bottom;
    if (state.start.shown() && state.start.draw(host)) state.files.open(FileBrowser::For::Open);
    state.files.draw(host);
    state.search.draw(host);
    if (state.help) state.drawHelp(host);
    drawNotices(host, 0, state.sideTaken, top);
}

Panels::Rest Panels::rest(const glm::vec2& whole) const {
    const float taken = mState->beside ? mState->sideTaken : 0;
    return {{0, 0}, {std::max(whole.x - taken, 1.0f), whole.y}};
}

void Panels::toggleAll() {
    mState->hidden = !mState->hidden;
}
void Panels::toggleSide() {
    mState->hidden = false;
    mState->side = !mState->side;
}
void Panels::openSearch() {
    mState->search.open();
}
void Panels::openFiles() {
    mState->files.open(FileBrowser::For::Open);
}
void Panels::openSave() {
    mState->files.open(FileBrowser::For::SaveScene);
}
void Panels::showStart(bool shown) {
    mState->start.show(shown);
}
bool Panels::startShown() const {
    return mState->start.shown();
}
void Panels::toggleHelp() {
    mState->help = !mState->help;
}

bool Panels::closeOne() {
    State& state = *mState;
    if (state.search.isOpen()) return state.search.close(), true;
    if (state.files.isOpen()) return state.files.close(), true;
    if (state.help) return state.help = false, true;
    if (state.start.shown()) return state.start.show(false), true;
    return false;
}

}  // namespace stereonav
