// What a file is, in lines below its name.
#pragma once

#include "app/view/file_looks.h"

namespace stereonav {

// At most so many lines. wrap: of a long one, as ImGui::PushTextWrapPos takes it.
void drawFileLook(const FileLook& look, int mostLines, float wrap = 0);

}  // namespace stereonav
