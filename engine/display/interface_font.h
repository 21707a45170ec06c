// The letters of the interface (engine/letters/letter_font.h), for Dear ImGui.
#pragma once

struct ImFontAtlas;

namespace stereonav {

// Makes this the atlas's only font. pixels: height.
void useInterfaceFont(ImFontAtlas& atlas, float pixels);

}  // namespace stereonav
