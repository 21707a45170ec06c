// What a file is, in lines below its name.
#pragma once

#include "app/view/panel/panel_host.h"

namespace stereonav {

// At most so many lines. wrap: of a long one, as ImGui::PushTextWrapPos takes it.
void drawFileLook(PanelHost& host, const FileLook& look, int mostLines, float wrap = 0);

}  // namespace stereonav
