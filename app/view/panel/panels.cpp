#include "app/view/panel/panels.h"

#include <imgui.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "app/view/clipboard.h"
#include "app/view/flown_keyframes.h"
#include "app/view/frame_presenter.h"
#include "app/view/input.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/coverage_panel.h"
#include "app/view/panel/file_browser.h"
#include "app/view/panel/findings_panel.h"
#include "app/view/panel/map_panel.h"
#include "app/view/panel/measure_panel.h"
#include "app/view/panel/menu_bar.h"
#include "app/view/panel/places_panel.h"
#include "app/view/panel/search.h"
#include "app/view/panel/second_panel.h"
#include "app/view/panel/side_panels.h"
#include "app/view/panel/slices_panel.h"
#include "app/view/panel/start_page.h"
#include "app/view/panel/start_pictures.h"
#include "app/view/panel/status_bar.h"
#include "app/view/panel/unfolded_panel.h"
#include "app/view/panel_stage.h"
#include "app/view/picture_pointer.h"
#include "app/view/second_side.h"

namespace stereonav {
namespace {

// Widths in heights of letters.
constexpr float kNarrowest = 10;
constexpr float kBeside = 56;   // least width of the interface for panels beside the picture
constexpr float kPicture = 20;  // least width that is left for the picture
constexpr float kStrip = 13;    // height of the unfolded wall
constexpr ImGuiWindowFlags kPlainBox = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoBringToFrontOnFocus;

}  // namespace

struct Panels::State {
    // A column of panels at one side of the picture.
    struct Column {
        bool shown = false;
        float width = 22;  // in heights of letters
        float taken = 0;   // width in the last layout, in units
    };
    bool hidden = false, help = false;
    Column left, side;
    bool showsUnfolded = false;
    float strip = 0;  // height of the strip below the picture in the last layout, in units
    UnfoldedPanel unfolded;
    bool beside = true;          // whether columns take their room from the picture
    float above = 0, below = 0;  // heights of menu bar and status bar in the last layout, in units
    CoveragePanel coverage;
    MapPanel map;
    PlacesPanel places;
    SlicesPanel slices;
    SecondPanel second;
    FindingsPanel findings;
    bool showFindings = false;  // opens the findings in the next layout and scrolls to them
    SearchBox search;
    FileBrowser files;
    StartPage start;
    SideTools tools;

    void open(const PanelParts& parts, const std::filesystem::path& file);
    void drawHelp();
    void drawColumn(Column& column, bool atRight, float top, const std::function<void()>& content);
    void drawLeft(const PanelParts& parts);
    void drawUnfolded(const PanelParts& parts);
    void drawFindings(const PanelParts& parts);
};

Panels::Panels() : mState(std::make_unique<State>()) {}
Panels::~Panels() = default;

// Opens a chosen file; failures become notices.
void Panels::State::open(const PanelParts& parts, const std::filesystem::path& file) {
    ViewSession* const session = parts.session;
    switch (files.purpose()) {
        case FileBrowser::For::Open:
            return parts.changes.open(file.string());
        case FileBrowser::For::OpenOther:
            return parts.second.open(file.string());
        case FileBrowser::For::OpenPath:
            if (session) parts.notices.tryTo([&] { session->paths().open(readPath(file)); });
            return;
        case FileBrowser::For::SaveScene:
            parts.notices.tryTo([&] {
                const std::filesystem::path place = parts.changes.settings().save(file);
                if (session) session->notify("saved " + place.string());
            });
    }
}

void Panels::State::drawHelp() {
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
                quietLine(keys[n].meaning + "   ");
            }
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void Panels::State::drawColumn(Column& column, bool atRight, float top,
                               const std::function<void()>& content) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize(), height = std::max(whole.y - top, 1.0f);
    const float other = (atRight ? left : side).taken;
    const float most = std::max((beside ? whole.x - other - kPicture * font : whole.x - 4 * font), 4 * font);
    const float width = std::min(column.width * font, most);
    ImGui::PushID(atRight);
    ImGui::SetNextWindowPos({atRight ? whole.x - width : 0, top});
    ImGui::SetNextWindowSize({width, height});
    // The scroll bar is always there, so that the layout does not change where the content gets longer.
    ImGui::Begin(atRight ? "##side" : "##left", nullptr,
                 (kPlainBox & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_AlwaysVerticalScrollbar);
    content();
    ImGui::End();
    column.taken = width;
    // The inner border can be dragged.
    const float border = atRight ? whole.x - width : width;
    ImGui::SetNextWindowPos({border - 0.25f * font, top});
    ImGui::SetNextWindowSize({0.5f * font, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin(atRight ? "##side border" : "##left border", nullptr,
                 kPlainBox | ImGuiWindowFlags_NoBackground);
    ImGui::InvisibleButton("##grip", {0.5f * font, height});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive()) {
        const float moved = ImGui::GetIO().MouseDelta.x / font;
        column.width = std::clamp(width / font + (atRight ? -moved : moved),
                                  std::min(kNarrowest, most / font), most / font);
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopID();
}

void Panels::State::drawLeft(const PanelParts& parts) {
    ViewSession* const session = parts.session;
    if (!session) return quietText("nothing is open yet");
    Instruments& instruments = parts.instruments;
    const auto open = [](const char* label) {
        return ImGui::CollapsingHeader(label, ImGuiTreeNodeFlags_DefaultOpen);
    };
    if (open("Places")) places.draw(parts.kept, parts.actions);
    if (MapPanel::has(*session) && open("Map"))
        map.draw(*session, parts.keyframes.edit(), parts.stage.eyeSize());
    if (ImGui::CollapsingHeader("Measure", instruments.measuring() || !instruments.line().places().empty()
                                               ? ImGuiTreeNodeFlags_DefaultOpen
                                               : 0))
        drawMeasurePanel(instruments, parts.jobs, *session, parts.clipboard);
    if (FindingsPanel::has(instruments)) drawFindings(parts);
    coverage.draw(instruments.coverage(), *session, parts.actions);
    if (SecondPanel::has(session) && open("Other study") &&
        second.draw(parts.second, *session, parts.changes.loading().busy))
        files.open(FileBrowser::For::OpenOther);
    if (session->open().scene->offered<SliceSource>() && open("Slices"))
        slices.draw(*session, parts.study, instruments);
}

void Panels::State::drawFindings(const PanelParts& parts) {
    if (showFindings) ImGui::SetNextItemOpen(true);
    const bool open = ImGui::CollapsingHeader(
        "Findings", FindingsPanel::inUse(parts.instruments) ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    if (std::exchange(showFindings, false)) ImGui::SetScrollHereY(0);
    if (!open) return;
    if (const auto place =
            findings.draw(parts.instruments, parts.study, *parts.session, parts.notices, parts.clipboard))
        slices.show(*place);
}

// Draws the unfolded wall between the columns, above the status bar.
void Panels::State::drawUnfolded(const PanelParts& parts) {
    if (!showsUnfolded || hidden || !UnfoldedPanel::has(parts.session))
        return unfolded.hide(parts.session, parts.instruments);
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float height = std::min(kStrip * ImGui::GetFontSize(), 0.5f * whole.y);
    ImGui::SetNextWindowPos({left.taken, whole.y - below - height});
    ImGui::SetNextWindowSize({std::max(whole.x - left.taken - side.taken, 1.0f), height});
    ImGui::Begin("##unfolded", nullptr, kPlainBox);
    unfolded.draw(*parts.session, parts.instruments, parts.pictures.frame(), parts.pointer.world());
    ImGui::End();
    strip = height;
}

void Panels::draw(const PanelParts& parts) {
    State& state = *mState;
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    state.left.taken = state.side.taken = 0;
    state.beside = whole.x >= kBeside * ImGui::GetFontSize();
    state.above = state.below = state.strip = 0;
    float& top = state.above;
    const bool sideBefore = state.side.shown;
    if (!state.hidden) {
        MenuWishes wishes;
        wishes.side = &state.side.shown;
        wishes.left = &state.left.shown;
        wishes.other = SecondPanel::has(parts.session);
        if (UnfoldedPanel::has(parts.session)) wishes.unfolded = &state.showsUnfolded;
        top = drawMenuBar(parts, wishes);
        if (wishes.openFile) state.files.open(FileBrowser::For::Open);
        if (wishes.openOther) state.files.open(FileBrowser::For::OpenOther);
        if (wishes.saveScene) state.files.open(FileBrowser::For::SaveScene);
        if (wishes.start) state.start.show(true);
        if (wishes.search) state.search.open();
        if (wishes.help) state.help = true;
        if (wishes.hideAll) state.hidden = true;
        if (wishes.picture) state.side.shown = state.tools.showPicture = true;
        if (wishes.movie) state.side.shown = state.tools.showPath = true;
        if (!state.beside && state.left.shown && state.side.shown) {
            // Only the drawer that was opened last stays open.
            (sideBefore ? state.side : state.left).shown = false;
        }
        if (state.left.shown) state.drawColumn(state.left, false, top, [&] { state.drawLeft(parts); });
        if (state.side.shown)
            state.drawColumn(state.side, true, top, [&] { drawSidePanels(parts, state.tools); });
        state.below = drawStatusBar(parts, state.left.taken, state.side.taken);
    }
    state.drawUnfolded(parts);
    if (state.start.shown() && state.start.draw(parts.changes, parts.kept, parts.looks))
        state.files.open(FileBrowser::For::Open);
    if (const auto chosen = state.files.draw(parts.looks)) state.open(parts, *chosen);
    state.search.draw(parts.changes, parts.actions);
    if (state.help) state.drawHelp();
    drawNotices(parts, state.left.taken, state.side.taken, top);
}

Panels::Rest Panels::rest(const glm::vec2& whole) const {
    const float top = mState->above, bottom = mState->below;
    if (!mState->beside) return {{0, 0}, whole, top, bottom};
    const float left = mState->left.taken, right = mState->side.taken;
    const float high = mState->strip > 0 ? whole.y - mState->strip - bottom : whole.y;
    return {{left, 0},
            {std::max(whole.x - left - right, 1.0f), std::max(high, 1.0f)},
            top,
            mState->strip > 0 ? 0 : bottom};
}

void Panels::toggleAll() {
    mState->hidden = !mState->hidden;
}
bool Panels::hidden() const {
    return mState->hidden;
}
void Panels::toggleSide() {
    mState->hidden = false;
    mState->side.shown = !mState->side.shown;
    if (!mState->beside && mState->side.shown) mState->left.shown = false;
}
void Panels::toggleLeft() {
    mState->hidden = false;
    mState->left.shown = !mState->left.shown;
    if (!mState->beside && mState->left.shown) mState->side.shown = false;
}
void Panels::toggleUnfolded() {
    mState->hidden = false;
    mState->showsUnfolded = !mState->showsUnfolded;
}
void Panels::showFindings() {
    if (!mState->left.shown) toggleLeft();
    mState->showFindings = true;
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
void Panels::openPaths() {
    mState->files.open(FileBrowser::For::OpenPath);
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

void Panels::setSide(bool shown, float width) {
    mState->side.shown = shown;
    mState->side.width = width / kInterfaceFontPixels;
}
void Panels::setLeft(bool shown, float width) {
    mState->left.shown = shown;
    mState->left.width = width / kInterfaceFontPixels;
}
bool Panels::sideShown() const {
    return mState->side.shown;
}
bool Panels::leftShown() const {
    return mState->left.shown;
}
float Panels::sideWidth() const {
    return mState->side.width * kInterfaceFontPixels;
}
float Panels::leftWidth() const {
    return mState->left.width * kInterfaceFontPixels;
}
void Panels::setFolder(const std::filesystem::path& folder) {
    mState->files.startIn(folder);
}
const std::filesystem::path& Panels::folder() const {
    return mState->files.folder();
}
void Panels::forget() {
    mState->map.forget();
    mState->places.forget();
    mState->slices.forget();
    mState->unfolded.forget();
    mState->second.forget();
    mState->tools.transfer.forget();
    mState->start.forget();
    forgetStartPictures();
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
