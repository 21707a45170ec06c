// The helper stereonav_picture_reader: unpacks pictures through OpenCV, WebP through its own library. OpenCV
// asks each of its decoders in turn whether a file is its own; those of PNG, JPEG, TIFF and BMP look at the
// first bytes, which the program has checked, and come before those that look elsewhere (DICOM at byte 128,
// DTED at 140). WebP's looks at more than the first bytes, and would leave a damaged file to them.
#include <webp/decode.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "engine/helper/serve_requests.h"
#include "engine/image/picture_reader/image_request.h"

namespace stereonav {
namespace {

cv::Mat webpOf(const ImageRequest& head, std::string_view file) {
    cv::Mat image(head.height, head.width, CV_8UC3);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(file.data());
    const bool whole = WebPDecodeBGRInto(bytes, file.size(), image.data, image.total() * image.elemSize(),
                                         static_cast<int>(image.step));
    return whole ? image : cv::Mat();
}

cv::Mat imageOf(const ImageRequest& head, std::string_view file) {
    if (head.format == PictureFormat::WebP) return webpOf(head, file);
    try {
        const cv::Mat bytes(1, static_cast<int>(file.size()), CV_8U, const_cast<char*>(file.data()));
        return cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
    } catch (const cv::Exception&) {
        return {};
    }
}

std::string unpack(std::string_view request) {
    ImageRequest head;
    if (request.size() < sizeof head) throw std::runtime_error("expected a whole request");
    std::memcpy(&head, request.data(), sizeof head);
    const cv::Mat image = imageOf(head, request.substr(sizeof head));
    if (image.empty()) throw std::runtime_error("is not a picture this program can read, or it is cut off");
    const int depth = image.depth();
    if ((depth != CV_8U && depth != CV_16U && depth != CV_32F) || image.channels() != 3)
        throw std::runtime_error("expected 8, 16 or 32-bit float samples, got another depth");
    const ImageAnswer answer{image.cols, image.rows, static_cast<std::int32_t>(image.elemSize1())};
    const std::size_t row = image.elemSize() * static_cast<std::size_t>(image.cols);
    std::string bytes(row * static_cast<std::size_t>(image.rows) + sizeof answer, '\0');
    for (int y = 0; y < image.rows; ++y)
        std::memcpy(bytes.data() + row * static_cast<std::size_t>(y), image.ptr(y), row);
    std::memcpy(bytes.data() + bytes.size() - sizeof answer, &answer, sizeof answer);
    return bytes;
}

// Nothing but refusals comes out of here, each one line.
std::string unpackOrRefuse(std::string_view request) {
    try {
        return unpack(request);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error("damaged: unpacking it takes more memory than pictures of its size do");
    }
}

// Makes libraries find out, or load, what they need at their first use, before no file can be opened any
// more.
void useOnce() {
    const cv::Mat image(16, 16, CV_8UC3, cv::Scalar(1, 2, 3));
    std::vector<unsigned char> bytes;
    for (const char* extension : {".png", ".jpg", ".tif", ".bmp"})
        if (cv::imencode(extension, image, bytes))
            cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
}

}  // namespace
}  // namespace stereonav

int main() {
    cv::setNumThreads(0);  // no thread can be started any more
    stereonav::useOnce();
    return stereonav::serveRequests(stereonav::unpackOrRefuse);
}
