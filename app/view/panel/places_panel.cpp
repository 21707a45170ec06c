#include "app/view/panel/places_panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/view/panel/controls.h"
#include "engine/base/error.h"
#include "engine/image/image_file.h"

namespace stereonav {

void PlacesPanel::draw(KeptPlaces& kept, AskedActions& actions) {
    Bookmarks* const places = kept.places();
    if (!places) return;
    if (button("Home", "Flies back to the start. Key: Space")) actions.ask({ViewCommand::Home});
    ImGui::SameLine();
    if (button("+ Add", "Keeps this place, for this file. Key: Ctrl+B")) actions.ask({ViewCommand::AddPlace});
    if (places->list().empty()) quietText("No places yet: + keeps the one that is shown.");
    // Copied, since buttons change the list.
    const std::vector<Bookmark> list = places->list();
    for (const Bookmark& place : list) drawPlace(kept, *places, place);
}

void PlacesPanel::drawPlace(KeptPlaces& kept, Bookmarks& places, const Bookmark& place) {
    ImGui::PushID(place.name.c_str());
    const float font = ImGui::GetFontSize(), width = 4.6f * font;
    if (!place.thumbnail.empty()) {
        PanelTexture& picture = mPictures[place.thumbnail.string()];
        if (!picture.any()) try {
                picture.set(readColorImage(place.thumbnail), true);
            } catch (const Error&) {
                picture.set(Plane<PackedColor>(1, 1), true);  // the file does not exist any more: grey
            }
        if (ImGui::ImageButton(picture.id(), {width, width * kThumbnailHeight / kThumbnailWidth}, {0, 0},
                               {1, 1}, 0))
            kept.goTo(place);
        tooltip("Fly there.");
        ImGui::SameLine();
    }
    ImGui::BeginGroup();
    if (mRenaming == place.name) {
        ImGui::SetNextItemWidth(-FLT_MIN);
        const bool done = ImGui::InputText("##name", &mName, ImGuiInputTextFlags_EnterReturnsTrue);
        if (done || ImGui::IsItemDeactivated()) {
            if (!mName.empty() && mName != place.name) places.rename(place.name, mName);
            mRenaming.clear();
        }
    } else {
        plainText(place.name);
    }
    if (ImGui::SmallButton("Go")) kept.goTo(place);
    tooltip("Fly there.");
    ImGui::SameLine();
    if (ImGui::SmallButton("Rename")) mRenaming = mName = place.name;
    ImGui::SameLine();
    if (ImGui::SmallButton("\u2715")) places.remove(place.name);
    tooltip("Removes this place.");
    ImGui::EndGroup();
    ImGui::PopID();
}

}  // namespace stereonav
