#include "app/view/panel/start_page.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/view/panel/controls.h"
#include "app/view/panel/file_look_rows.h"
#include "app/view/panel/start_pictures.h"
#include "engine/base/error.h"
#include "engine/image/image_file.h"
#include "engine/text/printable.h"

namespace stereonav {
namespace {

constexpr int kMostRecent = 8;

struct Card {
    const char *scene, *title, *words;
};
constexpr Card kCards[] = {{"terrain", "Terrain", "mountains over a plain"},
                           {"colon", "Colon", "the inside of a colon"},
                           {"cloud", "Cloud", "light shines through"},
                           {"wax", "Wax", "light shines into it"}};

// Draws one scene to open: its picture, which moves under the pointer, and its name. width: units.
bool drawCard(const Card& card, float width) {
    ImGui::BeginGroup();
    ImGui::PushID(card.scene);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, width * kStartPictureHeight / kStartPictureWidth);
    const bool clicked = ImGui::InvisibleButton("##open", size);
    const bool hovered = ImGui::IsItemHovered();
    drawStartPicture(card.scene, from, size, hovered);
    if (hovered)
        ImGui::GetWindowDrawList()->AddRect(from, {from.x + size.x, from.y + size.y},
                                            ImGui::GetColorU32(accentNow()), 0, 0, 2);
    if (hovered) tooltip(card.words);
    ImGui::TextUnformatted(card.title);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    if (ImGui::CalcTextSize(card.title).x + gap + ImGui::CalcTextSize(card.words).x < width) {
        ImGui::SameLine();
        quietLine(card.words);
    }
    ImGui::PopID();
    ImGui::EndGroup();
    return clicked;
}

}  // namespace

// Draws a recent file; returns true where it is to be opened. width: units.
bool StartPage::drawRecentFile(FileLooks& looks, const RecentFile& file, float width) {
    const float font = ImGui::GetFontSize(), height = 2.6f * font;
    const ImVec2 picture(height * kThumbnailWidth / kThumbnailHeight, height);
    const std::string name =
        printable(file.path.filename().empty() ? file.path.string() : file.path.filename().string());
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::Selectable("##file", false, 0, {width, height});
    const bool hovered = ImGui::IsItemHovered();
    if (ImGui::BeginPopupContextItem()) {
        if (ImGui::MenuItem("Remove from this list")) mForget = file.path;
        ImGui::EndPopup();
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 to(from.x + picture.x, from.y + picture.y);
    if (PanelTexture* const texture = pictureOf(file))
        list.AddImage(texture->id(), from, to);
    else
        list.AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_FrameBg));
    // Long paths are cut; the tooltip has the whole path.
    const float text = to.x + 0.6f * font;
    list.PushClipRect({text, from.y}, {from.x + width, to.y}, true);
    list.AddText({text, from.y + 0.2f * font}, ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
    const std::string where = printable(file.path.parent_path().string());
    list.AddText({text, from.y + 1.35f * font}, ImGui::GetColorU32(quietNow()), where.c_str());
    list.PopClipRect();
    if (hovered) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(34 * font);
        plainText(file.path.string());
        drawFileLook(looks.look(file.path), 8, 34 * font);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
    return clicked;
}

// Returns the picture of a recent file; null where there is none.
PanelTexture* StartPage::pictureOf(const RecentFile& file) {
    if (file.thumbnail.empty()) return nullptr;
    const auto [known, fresh] = mPictures.try_emplace(file.thumbnail.string());
    if (fresh) try {
            known->second.set(readColorImage(file.thumbnail), true);
        } catch (const Error&) {
            // A picture that is gone or damaged is left out.
        }
    return known->second.any() ? &known->second : nullptr;
}

std::string StartPage::drawRecent(KeptPlaces& kept, FileLooks& looks, float width) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const int columns = width > 30 * ImGui::GetFontSize() ? 2 : 1;
    const float each = (width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
    std::string open;
    int shown = 0;
    for (const RecentFile& file : kept.recent().list()) {
        const std::string path = file.path.string();
        if (std::find_if(std::begin(kCards), std::end(kCards),
                         [&](const Card& card) { return path == card.scene; }) != std::end(kCards))
            continue;
        if (shown == kMostRecent) break;
        if (shown == 0) ImGui::Spacing();
        if (shown % columns != 0) ImGui::SameLine();
        ImGui::PushID(shown++);
        if (drawRecentFile(looks, file, each - 1)) open = path;
        ImGui::PopID();
    }
    if (!mForget.empty()) kept.forgetRecent(std::exchange(mForget, {}));
    return open;
}

bool StartPage::draw(SceneChanges& changes, KeptPlaces& kept, FileLooks& looks, bool& shown) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    const float width = std::min(whole.x - font, 56 * font);
    ImGui::SetNextWindowPos({whole.x / 2, whole.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(whole.y - 3 * font, 4 * font)});
    ImGui::Begin("##start", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
    bool look = false;
    std::string open;
    const float inside = width - 2 * ImGui::GetStyle().WindowPadding.x, gap = ImGui::GetStyle().ItemSpacing.x;
    const int columns = width > 30 * font ? 4 : 2;
    for (int n = 0; n < 4; ++n) {
        if (n % columns != 0) ImGui::SameLine();
        if (drawCard(kCards[n],
                     (inside - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns) - 1))
            open = kCards[n].scene;
    }
    ImGui::Spacing();
    if (button("Open a file or folder...", "An elevation model, a CT study, a mesh or a scene. Key: Ctrl+O"))
        look = true;
    ImGui::SameLine();
    quietText("or drop it here: GeoTIFF and other elevation models, DICOM, NIfTI, NRRD, glTF");
    if (const std::string recent = drawRecent(kept, looks, inside); !recent.empty()) open = recent;
    ImGui::Separator();
    quietText("Look: drag, or the arrow keys.");
    quietText("Fly: W S A D; the wheel changes the speed, Space goes home.");
    quietText(
        "Stereo: the menu Stereo has a mode for each display; M tries the next. Ctrl+P finds anything.");
    if (ImGui::Button("Close")) shown = false;
    ImGui::End();
    if (open.empty()) return look;
    shown = false;
    changes.open(open);
    return look;
}

}  // namespace stereonav
