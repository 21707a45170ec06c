// The letters of the interface (engine/letters/letter_font.h), as Dear ImGui takes them.
#pragma once

struct ImFontAtlas;

namespace stereonav {

// Puts the font into the atlas as its only one, pixels high.
void useInterfaceFont(ImFontAtlas& atlas, float pixels);

}  // namespace stereonav
