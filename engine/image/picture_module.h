// Functions of the module stereonav_pictures (OpenCV) for picture files; they are defined in
// engine/image/opencv.
#pragma once

#include "engine/image/image_file.h"

namespace stereonav {

struct PictureFunctions {
    decltype(&stereonav::encodeColorImage) encodeColorImage;
    decltype(&stereonav::canWritePicture) canWritePicture;
};

}  // namespace stereonav
