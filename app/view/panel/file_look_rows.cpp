#include "app/view/panel/file_look_rows.h"

#include <imgui.h>

#include "app/view/panel/controls.h"

namespace stereonav {

void drawFileLook(const FileLook& look, int mostLines, float wrap) {
    if (look.busy) return quietLine("looking ...");
    if (!look.problem.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, warningNow());
        ImGui::PushTextWrapPos(wrap);
        plainText(look.problem);
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        return;
    }
    int lines = 0;
    for (const auto& [label, words] : look.rows) {
        if (lines++ == mostLines) break;
        quietLine(label);
        ImGui::SameLine(7 * ImGui::GetFontSize());
        plainText(words);
    }
}

}  // namespace stereonav
