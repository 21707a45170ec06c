#include "app/view/panel/file_wish.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <utility>

#include "app/view/panel/controls.h"

namespace stereonav {
namespace {

std::optional<FileWish>& wished() {
    static std::optional<FileWish> wish;
    return wish;
}

bool browseButton() {
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    return button("...", "Looks for the file.");
}

}  // namespace

float browseWidth() {
    const ImGuiStyle& style = ImGui::GetStyle();
    return ImGui::CalcTextSize("...").x + 2 * style.FramePadding.x + style.ItemInnerSpacing.x;
}

void fileField(const char* id, const char* hint, std::string& field, float width) {
    ImGui::PushID(id);
    ImGui::SetNextItemWidth((width > 0 ? width : ImGui::GetContentRegionAvail().x + width) - browseWidth());
    ImGui::BeginGroup();
    ImGui::InputTextWithHint("##name", hint, &field);
    if (browseButton()) wished() = FileWish{"", &field, true};
    ImGui::EndGroup();
    ImGui::PopID();
}

void browseForOption(const char* key) {
    if (browseButton()) wished() = FileWish{key, nullptr, false};
}

std::optional<FileWish> takeFileWish() {
    return std::exchange(wished(), std::nullopt);
}

}  // namespace stereonav
