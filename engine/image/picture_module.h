// What picture files ask of the module stereonav_pictures (OpenCV); engine/image/opencv has the functions.
#pragma once

#include "engine/image/image_file.h"

namespace stereonav {

struct PictureFunctions {
    decltype(&stereonav::encodeColorImage) encodeColorImage;
    decltype(&stereonav::canWritePicture) canWritePicture;
};

}  // namespace stereonav
