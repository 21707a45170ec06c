// Writes a frame into a picture file: composed for a display, or with both eyes for 3D viewers.
#pragma once

#include <filesystem>
#include <string>

#include "app/output/stereo_frame.h"
#include "app/scene/shown_as.h"

namespace stereonav {

// Throws Error that names `option` where no picture can be written with this extension or in this place.
void checkStereoPicture(const std::string& option, const std::filesystem::path& file);

// Returns the bytes per pixel of an eye that are held while such a file is written.
PixelBytes pictureBytes(const std::filesystem::path& file);

// Writes by extension: .jps has both whole eyes, crossed; .mpo has two pictures; others are composed by
// `mode`. Returns the size as text, "1280x720" or "2 of 1280x720". Throws Error.
std::string writeStereoPicture(const std::filesystem::path& file, const StereoFrame& frame, OutputMode mode);

}  // namespace stereonav
