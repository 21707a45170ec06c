// Facts of a file, in lines below its name.
#pragma once

#include "app/view/file_looks.h"

namespace stereonav {

// Draws at most `mostLines` lines. wrap: position at which long lines wrap, as for ImGui::PushTextWrapPos.
void drawFileLook(const FileLook& look, int mostLines, float wrap = 0);

}  // namespace stereonav
