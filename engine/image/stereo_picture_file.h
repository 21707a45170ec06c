// Pictures of two eyes in one file that viewers and 3D screens know: .jps and .mpo, both made of JPEG.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Placement of the two eyes as a .mpo states it; NaN: unknown.
struct EyePlacement {
    double separation_m = 0;         // 0 or more
    double convergence_degrees = 0;  // between the two axes of view
};

// Returns whether the extension is .jps or .mpo, in small letters or capitals.
bool isJps(const std::filesystem::path& file);
bool isMpo(const std::filesystem::path& file);

// Returns one JPEG of both eyes beside each other, the right one on the left, with the segment that says so
// (APP3 "_JPSJPS_": Siragusa and others, General purpose stereoscopic data descriptor, VRex 1997). pair:
// composed as OutputMode::CrossEyed. Throws Error.
std::vector<unsigned char> jpsBytes(const Plane<PackedColor>& pair);

// Returns two JPEGs one behind the other, the left eye first, with an index (CIPA DC-007, Multi-Picture
// Format). Eyes of one size. Throws Error.
std::vector<unsigned char> mpoBytes(const Plane<PackedColor>& left, const Plane<PackedColor>& right,
                                    const EyePlacement& placement);

// Return the same from JPEG files that are there already, for jpsBytes and mpoBytes. width, height: pixels of
// one eye. Throw Error where a file is no whole JPEG.
std::vector<unsigned char> jpsFromJpeg(std::span<const unsigned char> pair);
std::vector<unsigned char> mpoFromJpegs(std::span<const unsigned char> left,
                                        std::span<const unsigned char> right, int width, int height,
                                        const EyePlacement& placement);

}  // namespace stereonav
