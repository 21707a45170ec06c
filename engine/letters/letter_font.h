// The font of the interface and of names in pictures: DejaVu Sans, whose licence lets programs carry it. It
// has figures of one width, the letters of most of Europe and the Near East, and the signs that stand on
// buttons.
#pragma once

#include <span>

namespace stereonav {

// The file's bytes, part of the program.
std::span<const unsigned char> letterFontFile();

}  // namespace stereonav
