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
#include "app/view/panel/file_wish.h"
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
#include "app/view/second_side.h"
#include "app/view/view_action.h"
#include "app/view/window_jobs.h"

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
    ShownPanels shown;
    UnfoldedPanel unfolded;
    CoveragePanel coverage;
    MapPanel map;
    PlacesPanel places;
    SlicesPanel slices;
    SecondPanel second;
    FindingsPanel findings;
    bool showFindings = false;  // opens the findings in the next layout and scrolls to them
    SearchBox search;
    FileBrowser files;
    FileWish wished;      // the file that is looked for
    std::string exports;  // the command that makes it; "": none
    StartPage start;
    SideTools tools;

    void open(const PanelParts& parts, const std::filesystem::path& file);
    void drawHelp();
    void drawColumn(ShownPanels::Column& column, bool atRight, float top,
                    const std::function<void()>& content);
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
            if (parts.changes.open(file.string())) shown.start = false;
            return;
        case FileBrowser::For::OpenOther:
            return parts.second.open(file.string());
        case FileBrowser::For::OpenPath:
            if (session) parts.notices.tryTo([&] { session->paths().open(readPath(file)); });
            return;
        case FileBrowser::For::Pick:
            return parts.changes.set(wished.key, file.string());
        case FileBrowser::For::Name:
            if (!exports.empty()) return parts.jobs.exportFile(std::exchange(exports, ""), file.string());
            if (wished.field) *wished.field = file.string();
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
    ImGui::Begin("Keys", &shown.help,
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

void Panels::State::drawColumn(ShownPanels::Column& column, bool atRight, float top,
                               const std::function<void()>& content) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize(), height = std::max(whole.y - top, 1.0f);
    const float other = (atRight ? shown.left : shown.side).taken;
    const float most =
        std::max((shown.beside ? whole.x - other - kPicture * font : whole.x - 4 * font), 4 * font);
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
    if (MapPanel::has(*session) && open("Map")) map.draw(*session, parts.keyframes.edit(), parts.eyeSize);
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
    if (!shown.unfolded || shown.hidden || !UnfoldedPanel::has(parts.session))
        return unfolded.hide(parts.session, parts.instruments);
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float height = std::min(kStrip * ImGui::GetFontSize(), 0.5f * whole.y);
    const float left = shown.left.taken, width = whole.x - left - shown.side.taken;
    ImGui::SetNextWindowPos({left, whole.y - shown.below - height});
    ImGui::SetNextWindowSize({std::max(width, 1.0f), height});
    ImGui::Begin("##unfolded", nullptr, kPlainBox);
    unfolded.draw(*parts.session, parts.instruments, parts.pictures.frame(), parts.pointed);
    ImGui::End();
    shown.strip = height;
}

void Panels::draw(const PanelParts& parts) {
    State& state = *mState;
    ShownPanels& shown = state.shown;
    ShownPanels::Column &left = shown.left, &side = shown.side;
    left.taken = side.taken = 0;
    shown.beside = ImGui::GetIO().DisplaySize.x >= kBeside * ImGui::GetFontSize();
    shown.above = shown.below = shown.strip = 0;
    const bool sideBefore = side.shown;
    if (!shown.hidden) {
        MenuWishes wishes;
        shown.above = drawMenuBar(parts, shown, wishes);
        if (wishes.open) state.files.open(*wishes.open);
        if (!wishes.exports.empty()) {
            state.exports = wishes.exports;
            state.files.open(FileBrowser::For::Name, wishes.exportName);
        }
        if (wishes.search) state.search.open();
        if (wishes.place) state.search.openForPlace();
        if (wishes.picture) side.shown = state.tools.showPicture = true;
        if (wishes.movie) side.shown = state.tools.showPath = true;
        if (!shown.beside && left.shown && side.shown) {
            // Only the drawer that was opened last stays open.
            (sideBefore ? side : left).shown = false;
        }
        if (left.shown) state.drawColumn(left, false, shown.above, [&] { state.drawLeft(parts); });
        if (side.shown)
            state.drawColumn(side, true, shown.above, [&] { drawSidePanels(parts, state.tools); });
        shown.below = drawStatusBar(parts, left.taken, side.taken, shown.figures);
    }
    state.drawUnfolded(parts);
    if (!shown.start)
        state.start.forget();  // pictures may have changed until it is shown again
    else if (state.start.draw(parts.changes, parts.kept, parts.looks, shown.start))
        state.files.open(FileBrowser::For::Open);
    if (const auto wish = takeFileWish()) {
        state.wished = *wish;
        state.exports.clear();
        state.files.open(wish->saves ? FileBrowser::For::Name : FileBrowser::For::Pick,
                         wish->saves ? std::filesystem::path(*wish->field).filename().string() : "");
    }
    if (const auto chosen = state.files.draw(parts.looks)) state.open(parts, *chosen);
    state.search.draw(parts.changes, parts.actions, parts.session);
    if (shown.help) state.drawHelp();
    drawNotices(parts, left.taken, side.taken, shown.above);
}

ShownPanels& Panels::shown() {
    return mState->shown;
}
const ShownPanels& Panels::shown() const {
    return mState->shown;
}
void Panels::showFindings() {
    if (!mState->shown.left.shown) mState->shown.toggleLeft();
    mState->showFindings = true;
}
void Panels::openSearch() {
    mState->search.open();
}
bool Panels::open(ViewCommand command) {
    ShownPanels& shown = mState->shown;
    SideTools& tools = mState->tools;
    switch (command) {
        case ViewCommand::OpenOther:
            openFiles(FileBrowser::For::OpenOther);
            return true;
        case ViewCommand::ShowLeft:
            if (!shown.left.shown) shown.toggleLeft();
            return true;
        case ViewCommand::SavePictureAs:
        case ViewCommand::MakeMovie:
            (command == ViewCommand::MakeMovie ? tools.showPath : tools.showPicture) = true;
            [[fallthrough]];
        case ViewCommand::ShowSide:
            if (!shown.side.shown) shown.toggleSide();
            return true;
        default:
            return false;
    }
}
void Panels::openPlace() {
    mState->search.openForPlace();
}
void Panels::openFiles(FileBrowser::For what) {
    mState->files.open(what);
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

bool Panels::holdsKeys() const {
    return mState->search.isOpen() || mState->files.isOpen();
}

bool Panels::closeOne() {
    State& state = *mState;
    if (state.search.isOpen()) return state.search.close(), true;
    if (state.files.isOpen()) return state.files.close(), true;
    return std::exchange(state.shown.help, false) || std::exchange(state.shown.start, false);
}

}  // namespace stereonav
