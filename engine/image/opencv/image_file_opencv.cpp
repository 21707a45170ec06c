// The module stereonav_pictures: picture files through OpenCV's imgcodecs.
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/module.h"
#include "engine/image/opencv/byte_image.h"
#include "engine/image/picture_module.h"

namespace stereonav {
namespace {

// The decoders below show the upper part of a cut-off JPEG as if it were whole, and print about a
// cut-off PNG, so both are checked for their end: a JPEG's end marker (FFD9) comes after its last scan
// (FFDA), a PNG closes with the chunk IEND.
bool isCutOff(std::string_view content) {
    if (content.starts_with("\xff\xd8")) {
        const auto scan = content.rfind("\xff\xda");
        return scan == std::string_view::npos || content.find("\xff\xd9", scan) == std::string_view::npos;
    }
    return content.starts_with("\x89PNG") && content.rfind("IEND") == std::string_view::npos;
}

cv::Mat decodeAny(std::string_view content, const std::string& file, const std::string& place) {
    if (content.empty()) throw Error(file, place, "the picture is empty", "name an image file");
    if (isCutOff(content)) throw Error(file, place, "is cut off: its end is missing", "copy it again");
    cv::Mat image;
    try {
        const cv::Mat bytes(1, static_cast<int>(content.size()), CV_8U, const_cast<char*>(content.data()));
        image = cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
    } catch (const cv::Exception&) {
    }
    if (image.empty())
        throw Error(file, place, "is not a picture this program can read, or it is cut off",
                    "give a PNG, JPEG, TIFF, BMP or Radiance .hdr file");
    return image;
}

cv::Mat readAny(const std::filesystem::path& file) {
    const std::string content = readTextFile(file);
    if (content.empty()) throw Error(file.string(), "", "the file is empty", "name an image file");
    return decodeAny(content, file.string(), "");
}

glm::vec3 linearPixel(const cv::Mat& image, int y, int x) {
    switch (image.depth()) {
        case CV_8U: {
            const auto p = image.at<cv::Vec3b>(y, x);
            return {linearFromSrgb(p[2] / 255.0f), linearFromSrgb(p[1] / 255.0f),
                    linearFromSrgb(p[0] / 255.0f)};
        }
        case CV_16U: {
            const auto p = image.at<cv::Vec3w>(y, x);
            return {linearFromSrgb(p[2] / 65535.0f), linearFromSrgb(p[1] / 65535.0f),
                    linearFromSrgb(p[0] / 65535.0f)};
        }
        default: {
            const auto p = image.at<cv::Vec3f>(y, x);
            return {p[2], p[1], p[0]};
        }
    }
}

void checkDepth(const cv::Mat& image, const std::filesystem::path& file) {
    if (image.depth() != CV_8U && image.depth() != CV_16U && image.depth() != CV_32F)
        throw Error(file.string(), "", "expected 8, 16 or 32-bit float samples, got another depth",
                    "convert the picture to 8 bits");
}

Plane<PackedColor> packedFrom(const cv::Mat& image) {
    Plane<PackedColor> plane(image.cols, image.rows);
    const auto& table = packedFromSrgbByte();
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x) {
            if (image.depth() == CV_8U) {
                const auto p = image.at<cv::Vec3b>(y, x);
                plane.at(x, y) =
                    static_cast<PackedColor>(table[p[2]] | table[p[1]] << 10 | table[p[0]] << 20);
            } else {
                plane.at(x, y) = packColor(linearPixel(image, y, x));
            }
        }
    return plane;
}

}  // namespace

Plane<PackedColor> readColorImage(const std::filesystem::path& file) {
    const cv::Mat image = readAny(file);
    checkDepth(image, file);
    return packedFrom(image);
}

Plane<PackedColor> decodeColorImage(std::span<const unsigned char> bytes, const std::string& file,
                                    const std::string& place) {
    const cv::Mat image = decodeAny({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, place);
    checkDepth(image, file);
    return packedFrom(image);
}

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

static LinearImage decodeLinearImage(const std::filesystem::path& file) {
    const cv::Mat image = readAny(file);
    checkDepth(image, file);
    LinearImage linear{image.cols, image.rows, {}};
    linear.pixels.reserve(static_cast<std::size_t>(image.cols) * image.rows);
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x) linear.pixels.push_back(linearPixel(image, y, x));
    return linear;
}

bool canWritePicture(const std::string& extension) {
    try {
        return cv::haveImageWriter("picture" + extension);
    } catch (const cv::Exception&) {
        return false;
    }
}

static constexpr PictureFunctions kFunctions = {readColorImage, decodeColorImage, encodeColorImage,
                                                decodeLinearImage, canWritePicture};
const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
