#include "app/view/panel/start_page.h"

#include <imgui.h>

#include <algorithm>

#include "app/view/panel/controls.h"
#include "app/view/panel/start_pictures.h"

namespace stereonav {
namespace {

struct Card {
    const char *scene, *title, *words;
};
constexpr Card kCards[] = {{"terrain", "Terrain", "mountains over a plain"},
                           {"colon", "Colon", "the inside of a colon"},
                           {"cloud", "Cloud", "light that goes through"},
                           {"wax", "Wax", "light that goes in"}};

// One scene to open: its picture, which moves under the pointer, and its name. width: units.
bool drawCard(PanelHost& host, const Card& card, float width) {
    ImGui::BeginGroup();
    ImGui::PushID(card.scene);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, width * kStartPictureHeight / kStartPictureWidth);
    const bool clicked = ImGui::InvisibleButton("##open", size);
    const bool hovered = ImGui::IsItemHovered();
    drawStartPicture(card.scene, from, size, hovered);
    if (hovered)
        ImGui::GetWindowDrawList()->AddRect(from, {from.x + size.x, from.y + size.y},
                                            ImGui::GetColorU32(accentColor(host.look())), 0, 0, 2);
    if (hovered) tooltip(card.words);
    ImGui::TextUnformatted(card.title);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    if (ImGui::CalcTextSize(card.title).x + gap + ImGui::CalcTextSize(card.words).x < width) {
        ImGui::SameLine();
        quietLine(host, card.words);
    }
    ImGui::PopID();
    ImGui::EndGroup();
    return clicked;
}

}  // namespace

bool StartPage::draw(PanelHost& host) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    const float width = std::min(whole.x - font, 56 * font);
    ImGui::SetNextWindowPos({whole.x / 2, whole.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(whole.y - 3 * font, 4 * font)});
    ImGui::Begin("##start", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
    bool look = false;
    const float inside = width - 2 * ImGui::GetStyle().WindowPadding.x, gap = ImGui::GetStyle().ItemSpacing.x;
    const int columns = width > 30 * font ? 4 : 2;
    for (int n = 0; n < 4; ++n) {
        if (n % columns != 0) ImGui::SameLine();
        if (drawCard(host, kCards[n],
                     (inside - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns) - 1)) {
            mShown = false;
            host.open(kCards[n].scene);
        }
    }
    ImGui::Spacing();
    if (ImGui::Button("Open a file or folder...")) look = true;
    tooltip("An elevation model, a CT study, a mesh or a scene. Key: Ctrl+O");
    ImGui::SameLine();
    quietText(host, "or drop it here: GeoTIFF and other elevation models, DICOM, NIfTI, NRRD, glTF");
    const auto& recent = host.recentFiles();
    for (std::size_t n = 0; n < std::min<std::size_t>(recent.size(), 8); ++n) {
        ImGui::PushID(static_cast<int>(n));
        const std::string path = recent[n].path.string();
        if (std::find_if(std::begin(kCards), std::end(kCards),
                         [&](const Card& card) { return path == card.scene; }) == std::end(kCards) &&
            ImGui::Selectable(path.c_str())) {
            mShown = false;
            host.open(path);
        }
        ImGui::PopID();
    }
    ImGui::Separator();
    quietText(host, "Look: drag, or the arrow keys.");
    quietText(host, "Fly: W S A D; the wheel changes the speed, Space goes home.");
    quietText(
        host,
        "Stereo: the menu Stereo has a mode for each display; M tries the next. Ctrl+P finds anything.");
    if (ImGui::Button("Close")) mShown = false;
    ImGui::End();
    return look;
}

}  // namespace stereonav
