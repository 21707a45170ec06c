// The font of the interface: DejaVu Sans, whose licence lets programs carry it. It has figures of one width,
// the letters of most of Europe and the Near East, and the signs that stand on buttons.
#pragma once

#include <span>

struct ImFontAtlas;

namespace stereonav {

// The file's bytes, part of the program.
std::span<const unsigned char> interfaceFontFile();

// Puts it into the atlas as its only font, pixels high.
void useInterfaceFont(ImFontAtlas& atlas, float pixels);

}  // namespace stereonav
