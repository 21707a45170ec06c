#include "colon/study/dicom_uid.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/base/hash.h"

namespace stereonav {

std::string uidOfText(std::string_view text) {
    std::uint64_t high = Hash().add("stereonav UID, high").add(text).value();
    std::uint64_t low = Hash().add("stereonav UID, low").add(text).value();
    high = (high & ~0xf000ull) | 0x8000ull;            // version 8: of the maker's own scheme
    low = (low & ~(0xc0ull << 56)) | (0x80ull << 56);  // variant of RFC 9562
    std::array<std::uint32_t, 4> words = {
        static_cast<std::uint32_t>(high >> 32), static_cast<std::uint32_t>(high),
        static_cast<std::uint32_t>(low >> 32), static_cast<std::uint32_t>(low)};
    std::string digits;
    while (std::any_of(words.begin(), words.end(), [](std::uint32_t w) { return w != 0; })) {
        std::uint64_t rest = 0;
        for (std::uint32_t& word : words) {
            rest = rest << 32 | word;
            word = static_cast<std::uint32_t>(rest / 10);
            rest %= 10;
        }
        digits += static_cast<char>('0' + rest);
    }
    std::reverse(digits.begin(), digits.end());
    return "2.25." + digits;
}

}  // namespace stereonav
