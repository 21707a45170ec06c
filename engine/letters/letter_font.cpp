#include "engine/letters/letter_font.h"

// The assembler puts the file into the program as it is: a compiler takes seconds for an array of that size.
asm(R"(
    .section .rodata
    .balign 16
stereonavFontBegin:
    .incbin ")" STEREONAV_FONT R"("
stereonavFontEnd:
    .byte 0
    .previous
)");
extern const unsigned char kFontBegin[] asm("stereonavFontBegin");
extern const unsigned char kFontEnd[] asm("stereonavFontEnd");

namespace stereonav {

std::span<const unsigned char> letterFontFile() {
    return {kFontBegin, kFontEnd};
}

}  // namespace stereonav
