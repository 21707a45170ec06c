// Picture files in memory, as OpenCV writes them.
#pragma once

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace stereonav::test {

inline std::string encoded(const cv::Mat& image, const std::string& extension,
                           const std::vector<int>& settings = {}) {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, image, bytes, settings);
    return {bytes.begin(), bytes.end()};
}

}  // namespace stereonav::test
