#include "app/view/panel/place_row.h"

#include <imgui.h>

#include "app/view/panel/controls.h"

namespace stereonav {

void PlaceRow::forget() {
    mScene.reset();
    mWords.clear();
    mFound.reset();
}

bool PlaceRow::draw(ViewSession& session, const std::string& words, bool entered, bool asked) {
    if (session.openShared() != mScene || words != mWords) {
        mScene = session.openShared();
        mWords = words;
        mFound = findPlace(*mScene->scene, words);
    }
    if (!mFound) {
        const std::string expected = asked ? expectedPlaces(*mScene->scene) : "";
        if (!expected.empty()) quietText("Expected " + expected + ".");
        if (asked && expected.empty()) quietText("This scene has no coordinates.");
        return false;
    }
    if (!mFound->problem.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, warningNow());
        wrappedText(mFound->problem + ".");
        ImGui::PopStyleColor();
        return false;
    }
    const std::string label = "Go to " + mFound->words;
    const bool clicked = ImGui::Selectable((label + "##place").c_str(), true);
    if (!clicked && !entered) return false;
    goToPlace(session, *mFound);
    return true;
}

}  // namespace stereonav
