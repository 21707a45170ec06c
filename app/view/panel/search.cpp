#include "app/view/panel/search.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "app/view/input.h"
#include "app/view/panel/controls.h"

namespace stereonav {
namespace {

std::string lowered(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Returns whether every word occurs in the text.
bool matches(const std::string& text, const std::string& words) {
    std::istringstream in(lowered(words));
    const std::string where = lowered(text);
    for (std::string word; in >> word;)
        if (where.find(word) == std::string::npos) return false;
    return true;
}

}  // namespace

void SearchBox::draw(SceneChanges& changes, AskedActions& actions) {
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
    const bool entered = ImGui::InputTextWithHint("##words", "options, commands, keys", &mWords,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    if (ImGui::IsItemEdited()) mChosen = 0;
    ImGui::BeginChild("##found");
    int row = 0;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow))) ++mChosen;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow))) mChosen = std::max(mChosen - 1, 0);
    for (const KeyHelp& help : viewKeys()) {
        if (!matches(help.meaning + " " + help.keys, mWords)) continue;
        ImGui::PushID(row);
        const bool chosen = row++ == mChosen;
        const bool clicked = ImGui::Selectable("##row", chosen);
        ImGui::SameLine(0.5f * font);
        ImGui::TextUnformatted(help.meaning.c_str());
        ImGui::SameLine(width - 9 * font);
        quietText(help.keys);
        if ((clicked || (entered && chosen)) && help.action) {
            mOpen = false;
            actions.ask(*help.action);
        }
        ImGui::PopID();
    }
    for (const Option& option : optionTable()) {
        if (!(option.commands & command::kView) || option.panel == OptionPanel::None) continue;
        if (!matches(labelOf(option) + " " + option.help, mWords)) continue;
        ImGui::PushID(&option);
        ++row;
        if (changes.settings().applies(option)) {
            optionControl(changes, option);
        } else {
            quietText(labelOf(option) + ": not of this scene");
        }
        quietText(option.help);
        ImGui::PopID();
    }
    mChosen = std::min(mChosen, std::max(row - 1, 0));
    if (row == 0) quietText("Nothing matches these words.");
    ImGui::EndChild();
    // After Enter, or a click on a row, the words go on being written.
    const bool popup = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
    if (mOpen && !ImGui::IsAnyItemActive() && !popup && !ImGui::IsMouseDown(ImGuiMouseButton_Left))
        mWrites = true;
    if (mOpen) ImGui::CaptureKeyboardFromApp(true);  // every key belongs to the box
    ImGui::End();
}

}  // namespace stereonav
