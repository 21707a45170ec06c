// Picture files. All foreign pictures come into the program through here, except rasters of terrain, which
// GDAL reads. They are unpacked by a separate program (decoded_picture.h). PNG is written here; other formats
// by OpenCV in the module stereonav_pictures (engine/image/opencv), which is loaded when it is first needed.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/base/file.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Reads PNG, JPEG, TIFF, BMP, WebP or Radiance, recognized by the file's first bytes and not by its name: 8
// or 16 bits, gray or colour, taken as sRGB; floats are linear. Row 0 is the top. Throws Error.
Plane<PackedColor> readColorImage(const std::filesystem::path& file);

// Reads a picture from its bytes in memory; file and place are named in errors. Throws Error.
Plane<PackedColor> decodeColorImage(std::span<const unsigned char> bytes, const std::string& file,
                                    const std::string& place);
// Returns the bytes of a picture file, 8-bit sRGB; extension: ".png" or ".jpg". Throws Error.
std::vector<unsigned char> encodeColorImage(const Plane<PackedColor>& image, const std::string& extension);

// A picture in linear RGB, row 0 at the top.
struct LinearImage {
    int width = 0, height = 0;
    std::vector<glm::vec3> pixels;  // width * height of them
};
// Reads the formats of readColorImage() as linear RGB. Throws Error.
LinearImage readLinearImage(const std::filesystem::path& file);

// Writes by extension (.png, .jpg, ...), 8-bit sRGB; "-" is PNG to standard output. Written as all files are
// (engine/base/file.h). Throws Error.
void writeColorImage(const std::filesystem::path& file, const Plane<PackedColor>& image,
                     Flush flush = Flush::ToDisk);
// Returns whether pictures can be written in the format of this extension, such as ".png".
bool canWritePicture(const std::string& extension);

}  // namespace stereonav
