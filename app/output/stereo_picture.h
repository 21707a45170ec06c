// A frame into a picture's file: composed as a display wants it, or as files for 3D viewers have both eyes.
#pragma once

#include <filesystem>
#include <string>

#include "app/output/stereo_frame.h"
#include "app/scene/shown_as.h"

namespace stereonav {

// Throws Error naming `option` where the extension is none of a picture that can be written, or the place can
// not be written.
void checkStereoPicture(const std::string& option, const std::filesystem::path& file);

// What is held for each pixel of an eye while such a file is written.
PixelBytes pictureBytes(const std::filesystem::path& file);

// By extension: .jps has both eyes whole, crossed; .mpo has them as two pictures; others are as `mode` says.
// Gives the size as text, "1280x720" or "2 of 1280x720". Throws Error.
std::string writeStereoPicture(const std::filesystem::path& file, const StereoFrame& frame, OutputMode mode);

}  // namespace stereonav
