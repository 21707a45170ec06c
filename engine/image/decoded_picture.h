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

// Returns the picture in the helper's answer. head: of the picture file; the picture may lie on its side.
// Nothing where the answer is no such picture.
std::optional<DecodedPicture> decodedPictureOf(std::string answer, const PictureHead& head);

// Unpacks a picture. format: as the content's first bytes state it; not Radiance. pixelBytes: bytes that the
// caller will take for each pixel. Sizes are bounded, and memory is asked for in both processes, before
// anything is unpacked. Throws Error with file and place, and Cancelled.
DecodedPicture decodePicture(PictureFormat format, std::string_view content, std::size_t pixelBytes,
                             const std::string& file, const std::string& place);

}  // namespace stereonav
