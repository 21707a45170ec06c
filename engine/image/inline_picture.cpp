#include "engine/image/inline_picture.h"

#include "engine/image/png_writer.h"

namespace stereonav {

std::string base64(std::span<const unsigned char> bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t n = 0; n < bytes.size(); n += 3) {
        const std::size_t left = bytes.size() - n;
        const unsigned second = left > 1 ? bytes[n + 1] : 0, third = left > 2 ? bytes[n + 2] : 0;
        const unsigned three = static_cast<unsigned>(bytes[n]) << 16 | second << 8 | third;
        text += kDigits[three >> 18];
        text += kDigits[three >> 12 & 63];
        text += left > 1 ? kDigits[three >> 6 & 63] : '=';
        text += left > 2 ? kDigits[three & 63] : '=';
    }
    return text;
}

std::string inlinePicture(const Plane<PackedColor>& image) {
    return "data:image/png;base64," + base64(pngBytes(image));
}

}  // namespace stereonav
