// Compressed pictures of DICOM files, unpacked by the helper program stereonav_gdcm (GDCM; colon/study/gdcm).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/helper_pool.h"

namespace stereonav {

// Pixels as whole numbers in this machine's byte order.
struct DecodedPixels {
    std::string bytes;
    int bits = 16;  // a pixel: 8, 16 or 32
    bool isSigned = false;
};
// One compressed grey picture of a DICOM file, taken out of it and looked at (study_pixels.cpp).
struct PackedPicture {
    std::filesystem::path file;  // for messages
    std::string syntax;          // the transfer syntax, a UID
    int columns = 0, rows = 0;
    int bits = 16, stored = 16, high = 15;  // allocated, stored, the highest (PS3.5 8.1.1)
    bool isSigned = false;
    std::vector<std::string_view> parts;
};

// Returns the pixels that a helper answered for a picture of `count` pixels; nothing where the answer is no
// such picture.
std::optional<DecodedPixels> pixelsOf(std::string answer, std::uint64_t count);

// Unpacks the pictures of one study: its helpers see nothing else, and end with it.
class PictureDecoder {
public:
    PictureDecoder();
    // Unpacks a picture. From any thread. Throws Error naming the picture's file, and Cancelled.
    DecodedPixels decode(const PackedPicture& picture);

private:
    HelperPool mHelpers;
};

}  // namespace stereonav
