#include "engine/display/interface_font.h"

#include <imgui.h>

#include "engine/letters/letter_font.h"

namespace stereonav {

void useInterfaceFont(ImFontAtlas& atlas, float pixels) {
    static constexpr ImWchar kLetters[] = {
        0x0020, 0x024f,  // Latin
        0x0370, 0x052f,  // Greek, Cyrillic
        0x0590, 0x06ff,  // Hebrew, Arabic: not joined into words; names of files may have them
        0x1e00, 0x1eff,  // more Latin
        0x2010, 0x2044, 0x2070, 0x208e, 0x20ac, 0x20ac, 0x2100, 0x214f,  // punctuation, small digits, euro
        0x2190, 0x21ff, 0x2200, 0x2265, 0x25a0, 0x25ff, 0x2600, 0x2609,  // arrows, mathematics, shapes
        0x2699, 0x2699, 0x26a0, 0x26a0, 0x2713, 0x2718, 0};
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    const auto file = letterFontFile();
    atlas.Clear();
    atlas.Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
    atlas.AddFontFromMemoryTTF(const_cast<unsigned char*>(file.data()), static_cast<int>(file.size()), pixels,
                               &config, kLetters);
}

}  // namespace stereonav
