// The module stereonav_pictures: pictures packed by OpenCV's imgcodecs. It reads none: that is for the helper
// stereonav_picture_reader.
#include <opencv2/imgcodecs.hpp>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/image/opencv/byte_image.h"
#include "engine/image/picture_module.h"

namespace stereonav {

std::vector<unsigned char> encodeColorImage(const Plane<PackedColor>& image, const std::string& extension) {
    std::vector<unsigned char> bytes;
    bool encoded = false;
    try {
        encoded = cv::imencode(extension, bytesFromPlane(image), bytes);
    } catch (const cv::Exception&) {
    }
    if (!encoded) throw Error("", "picture", "can not be encoded as " + extension, "use .png or .jpg");
    return bytes;
}

bool canWritePicture(const std::string& extension) {
    try {
        return cv::haveImageWriter("picture" + extension);
    } catch (const cv::Exception&) {
        return false;
    }
}

static constexpr PictureFunctions kFunctions = {encodeColorImage, canWritePicture};
const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
