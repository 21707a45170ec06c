#include "app/view/panel/second_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "app/view/panel/controls.h"
#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

constexpr int kLeastWidth = 64, kMostWidth = 480;  // width of its picture

}  // namespace

bool SecondPanel::has(const ViewSession* session) {
    if (!session) return false;
    const Scene& scene = *session->open().scene;
    return scene.offered<const MatchingLine>() && scene.offered<RayCast>();
}

void SecondPanel::forget() {
    mTexture.reset();
    mShown.reset();
}

bool SecondPanel::draw(SecondSide& side, const ViewSession& session, bool loading) {
    SecondStudy& second = side.study();
    if (second.loading()) {
        quietText(fmt::format("opening the other study  {:.0f} %", 100 * second.fraction()));
        if (ImGui::Button("Cancel##second")) second.cancel();
        return false;
    }
    if (second.other()) {
        drawPicture(side, session, loading);
        return false;
    }
    quietText("The same colon in another study: its matching place is shown here.");
    return ImGui::Button("Open the other study...");
}

void SecondPanel::drawPicture(SecondSide& side, const ViewSession& session, bool loading) {
    SecondStudy& second = side.study();
    const auto place = second.matching(*session.open().scene, session.pose());
    if (!place) return;
    const float wide = std::max(ImGui::GetContentRegionAvail().x, 16.0f), high = 0.75f * wide;
    const int width = std::clamp(static_cast<int>(wide), kLeastWidth, kMostWidth);
    second.look(*place, {width, 3 * width / 4});
    if (const auto picture = second.picture(); picture != mShown) {
        mShown = picture;
        if (picture) mTexture.set(picture->color, true);
    }
    if (mShown)
        ImGui::Image(mTexture.id(), {wide, high});
    else
        ImGui::Dummy({wide, high});
    const std::filesystem::path name = second.other()->scene->name;
    quietText(fmt::format("{}: {:.0f} of {:.0f} mm along, looking {}",
                          name.filename().empty() ? name.string() : name.filename().string(),
                          1e3 * place->along, 1e3 * place->length, place->back ? "back" : "ahead"));
    if (!second.matches()) quietText("Not of the same colon: its places do not match.");
    tooltip(
        fmt::format("Matched along both centrelines; they differ by {:.2f}, where 0 is equal. Whether both "
                    "are of one patient is not checked.",
                    second.cost()));
    if (button("Swap", "Goes on in the other study; nothing is read again.", !loading)) side.swap();
    ImGui::SameLine();
    if (ImGui::Button("Close")) second.close();
}

}  // namespace stereonav
