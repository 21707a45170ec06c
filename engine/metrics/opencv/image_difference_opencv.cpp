// Image differences, through OpenCV.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/quality/qualitymse.hpp>
#include <opencv2/quality/qualityssim.hpp>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/image/opencv/byte_image.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {
namespace {

void checkSizes(const Plane<PackedColor>& truth, const Plane<PackedColor>& image) {
    if (truth.empty() || truth.width() != image.width() || truth.height() != image.height())
        throw Error("", "",
                    "expected two pictures of one size to compare, got " + std::to_string(truth.width()) +
                        "x" + std::to_string(truth.height()) + " and " + std::to_string(image.width()) + "x" +
                        std::to_string(image.height()),
                    "render both at the same size");
}

double psnrFromMse(double mse) {
    if (!(mse > 0.0)) return kIdenticalPsnr_db;
    return std::min(kIdenticalPsnr_db, 10.0 * std::log10(255.0 * 255.0 / mse));
}

double meanOfChannels(const cv::Scalar& value) {
    return (value[0] + value[1] + value[2]) / 3.0;
}

int squaredDistance(const cv::Vec3b& a, const cv::Vec3b& b) {
    int sum = 0;
    for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

double edgePsnr(const std::vector<float>& distance, const Plane<std::uint8_t>& mask) {
    double sum = 0;
    long long count = 0;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) {
            if (mask.at(x, y) == 0) continue;
            const double d = distance[static_cast<std::size_t>(y) * mask.width() + x];
            sum += d * d;
            ++count;
        }
    return count == 0 ? kIdenticalPsnr_db : psnrFromMse(sum / (3.0 * static_cast<double>(count)));
}

std::vector<float> distances(const cv::Mat& a, const cv::Mat& b) {
    std::vector<float> result;
    result.reserve(a.total());
    for (int y = 0; y < a.rows; ++y)
        for (int x = 0; x < a.cols; ++x)
            result.push_back(
                std::sqrt(static_cast<float>(squaredDistance(a.at<cv::Vec3b>(y, x), b.at<cv::Vec3b>(y, x)))));
    return result;
}

// The smallest value that at least 99 % of all values do not exceed.
double percentile99(std::vector<float> values) {
    const std::size_t rank = (values.size() * 99 + 99) / 100 - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
    return values[rank];
}

}  // namespace

double psnrOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image) {
    checkSizes(truth, image);
    const cv::Scalar mse =
        cv::quality::QualityMSE::compute(bytesFromPlane(truth), bytesFromPlane(image), cv::noArray());
    return psnrFromMse(meanOfChannels(mse));
}

ImageDifference differenceOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image,
                             const Plane<std::uint8_t>& edgeMask) {
    checkSizes(truth, image);
    if (edgeMask.width() != truth.width() || edgeMask.height() != truth.height())
        throw Error("", "", "expected an edge mask of the picture's size",
                    "make the mask from the same frame");
    const cv::Mat a = bytesFromPlane(truth), b = bytesFromPlane(image);
    const std::vector<float> distance = distances(a, b);
    ImageDifference result;
    result.psnr_db = psnrFromMse(meanOfChannels(cv::quality::QualityMSE::compute(a, b, cv::noArray())));
    result.ssim = meanOfChannels(cv::quality::QualitySSIM::compute(a, b, cv::noArray()));
    double sum = 0;
    for (const float d : distance) sum += d;
    result.rgb_mean = sum / static_cast<double>(distance.size());
    result.rgb_max = *std::max_element(distance.begin(), distance.end());
    result.rgb_p99 = percentile99(distance);
    result.edge_psnr_db = edgePsnr(distance, edgeMask);
    return result;
}

Plane<std::uint8_t> edgeMask(const Plane<std::uint8_t>& holeMask, const Plane<float>& viewDepth,
                             double parallaxScale, int radius) {
    const int width = viewDepth.width(), height = viewDepth.height();
    cv::Mat marked(height, width, CV_8U, cv::Scalar(0));
    // Pixels without a hit, and unknown ones (0), count as parallax 0.
    const auto parallax = [&](int x, int y) {
        const float z = viewDepth.at(x, y);
        return z > 0.0f ? parallaxScale / z : 0.0;
    };
    const auto mark = [&](int x, int y, int nextX, int nextY) {
        if (std::abs(parallax(x, y) - parallax(nextX, nextY)) <= 1.0) return;
        marked.at<std::uint8_t>(y, x) = marked.at<std::uint8_t>(nextY, nextX) = 255;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (x < holeMask.width() && y < holeMask.height() && holeMask.at(x, y) != 0)
                marked.at<std::uint8_t>(y, x) = 255;
            if (x + 1 < width) mark(x, y, x + 1, y);
            if (y + 1 < height) mark(x, y, x, y + 1);
        }
    const cv::Size window(2 * radius + 1, 2 * radius + 1);
    cv::dilate(marked, marked, cv::getStructuringElement(cv::MORPH_RECT, window));
    Plane<std::uint8_t> result(width, height);
    for (int y = 0; y < height; ++y) std::copy_n(marked.ptr(y), width, result.row(y));
    return result;
}

}  // namespace stereonav
