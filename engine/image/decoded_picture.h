// The samples of a picture file, unpacked by the helper program stereonav_picture_reader (OpenCV;
// engine/image/picture_reader).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/image/picture_format.h"

namespace stereonav {

// Blue, green and red of each pixel, rows from the top.
struct DecodedPicture {
    int width = 0, height = 0;
    int sampleBytes = 1;  // 1 or 2 of whole numbers, sRGB; 4 of floats, linear
    std::string samples;  // width * height * 3 numbers of sampleBytes bytes

    template <typename Sample>
    const Sample* pixels() const {
        return reinterpret_cast<const Sample*>(samples.data());
    }
};

// Returns what the helper answered for a picture with that head, which may lie on its side; nothing where it
// is no such picture.
std::optional<DecodedPicture> decodedPictureOf(std::string answer, const PictureHead& head);

// Unpacks a picture. format: what the content's first bytes say, and not Radiance. pixelBytes: what the
// caller makes of a pixel. Sizes are bounded, and memory asked for in both processes, before anything is
// unpacked. Throws Error with file and place, and Cancelled.
DecodedPicture decodePicture(PictureFormat format, std::string_view content, std::size_t pixelBytes,
                             const std::string& file, const std::string& place);

}  // namespace stereonav
