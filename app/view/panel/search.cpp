#include "app/view/panel/search.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/view/panel/controls.h"

namespace stereonav {
namespace {

// Draws a key or a menu's entry; returns whether it was clicked.
bool drawKey(const KeyHelp& help, bool chosen, float width) {
    const float font = ImGui::GetFontSize();
    const bool clicked = ImGui::Selectable("##row", chosen);
    ImGui::SameLine(0.5f * font);
    ImGui::TextUnformatted(help.meaning.c_str());
    ImGui::SameLine(width - 9 * font);
    quietText(help.keys);
    return clicked;
}

void drawOption(SceneChanges& changes, const Option& option) {
    if (option.panel == OptionPanel::None)
        quietText(labelOf(option) + ": on the command line, " + option.name());
    else if (changes.settings().applies(option))
        optionControl(changes, option);
    else
        quietText(labelOf(option) + ": not of this scene");
    quietText(option.help);
}

}  // namespace

// Draws the row of a place. Returns whether the words are a place, and nothing else.
bool SearchBox::drawPlace(ViewSession* session, bool entered) {
    if (session && mPlace.draw(*session, mWords, entered, mForPlace)) mOpen = false;
    return mForPlace || (session && mPlace.isPlace());
}

// Searches once for the same words, not for each picture.
const std::vector<SearchHit>& SearchBox::hits() {
    if (mSearched != mWords) mHits = searchHits(*(mSearched = mWords));
    return mHits;
}

void SearchBox::draw(SceneChanges& changes, AskedActions& actions, ViewSession* session) {
    if (!mOpen) return;
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    const float width = std::min(whole.x - 2 * font, 42 * font);
    ImGui::SetNextWindowPos({whole.x / 2, 3 * font}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({width, std::min(whole.y - 5 * font, 26 * font)});
    if (mFresh) ImGui::SetNextWindowFocus();
    ImGui::Begin("##search", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    if (!mFresh && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) mOpen = false;
    if (mFresh) {
        mWords.clear();
        mChosen = 0;
    }
    if (mFresh || mWrites) ImGui::SetKeyboardFocusHere();
    mFresh = mWrites = false;
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool entered =
        ImGui::InputTextWithHint("##words", mForPlace ? "a place" : "options, commands, keys, a place",
                                 &mWords, ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemEdited()) mChosen = 0;
    ImGui::BeginChild("##found");
    const bool place = drawPlace(session, entered);
    int row = 0;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow))) ++mChosen;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow))) mChosen = std::max(mChosen - 1, 0);
    static const std::vector<SearchHit> kNone;  // words that are a place
    for (const SearchHit& hit : place ? kNone : hits()) {
        const bool chosen = row++ == mChosen;
        ImGui::PushID(row);
        if (hit.option) drawOption(changes, *hit.option);
        if (hit.command)
            quietText(
                fmt::format("stereonav {}, on the command line: {}", hit.command->name, hit.command->help));
        const bool clicked = hit.key && drawKey(*hit.key, chosen, width);
        if (hit.key && hit.key->action && (clicked || (entered && chosen))) {
            mOpen = false;
            actions.ask(*hit.key->action);
        }
        ImGui::PopID();
    }
    mChosen = std::min(mChosen, std::max(row - 1, 0));
    if (row == 0 && !place) quietText("Nothing matches these words.");
    ImGui::EndChild();
    // After Enter, or a click on a row, the words go on being written.
    const bool popup = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
    if (mOpen && !ImGui::IsAnyItemActive() && !popup && !ImGui::IsMouseDown(ImGuiMouseButton_Left))
        mWrites = true;
    if (mOpen) ImGui::CaptureKeyboardFromApp(true);  // every key belongs to the box
    ImGui::End();
}

}  // namespace stereonav
