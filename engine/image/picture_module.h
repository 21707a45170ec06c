// What picture files ask of the module stereonav_pictures (OpenCV); engine/image/opencv has the functions.
#pragma once

#include "engine/image/image_file.h"

namespace stereonav {

struct PictureFunctions {
    decltype(&stereonav::readColorImage) readColorImage;
    decltype(&stereonav::decodeColorImage) decodeColorImage;
    decltype(&stereonav::encodeColorImage) encodeColorImage;
    decltype(&stereonav::readLinearImage) readLinearImage;  // but for .hdr
    decltype(&stereonav::canWritePicture) canWritePicture;
};

}  // namespace stereonav
