// What the readers of studies ask of the module stereonav_gdcm (GDCM); colon/gdcm has the function.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stereonav {

// Whole numbers in this machine's byte order.
struct DecodedPixels {
    std::vector<char> bytes;
    int bits = 16;  // a pixel: 8, 16 or 32
    bool isSigned = false;
};
// One compressed grey picture of a DICOM file, taken out of it and looked at (study_pixels.cpp).
struct PackedPicture {
    std::filesystem::path file;  // for messages
    std::string syntax;          // the transfer syntax, a UID
    int columns = 0, rows = 0;
    int bits = 16, stored = 16, high = 15;  // PS3.5 8.1.1
    bool isSigned = false;
    std::vector<std::string_view> parts;
};
// Nothing is printed. Throws Error.
DecodedPixels decodePicture(const PackedPicture& picture);

struct StudyFunctions {
    decltype(&stereonav::decodePicture) decodePicture;
};

}  // namespace stereonav
