// Radiance pictures: against OpenCV's reader, each way of packing a row, and damaged files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "engine/base/error.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RadianceFile : public testing::Test {
protected:
    RadianceFile() : mFile(testing::TempDir() + "radiance_" + std::to_string(getpid()) + ".hdr") {}
    ~RadianceFile() override { std::filesystem::remove(mFile); }

    void write(const std::string& content) { std::ofstream(mFile, std::ios::binary) << content; }

    std::string errorOf(const std::string& content) {
        write(content);
        try {
            readLinearImage(mFile);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), AllOf(HasSubstr(mFile.string() + ":"), Not(HasSubstr("\n"))));
            return error.what();
        }
        return "";
    }

    std::filesystem::path mFile;
};

std::string header(int width, int height) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
           std::to_string(width) + "\n";
}

std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int v : values) text += static_cast<char>(v);
    return text;
}

TEST_F(RadianceFile, ReadsWhatOpenCvReads) {
    cv::Mat image(37, 150, CV_32FC3);
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x)  // wide runs, single pixels, six orders of magnitude
            image.at<cv::Vec3f>(y, x) = {x < 60 ? 0.5f : 0.01f * static_cast<float>(x * y % 17),
                                         std::exp2(static_cast<float>(y - 18)), x % 2 ? 1e-3f : 0.0f};
    ASSERT_TRUE(cv::imwrite(mFile.string(), image));
    const cv::Mat other = cv::imread(mFile.string(), cv::IMREAD_UNCHANGED);
    const LinearImage mine = readLinearImage(mFile);
    ASSERT_EQ(mine.width, 150);
    ASSERT_EQ(mine.height, 37);
    for (int y = 0; y < 37; ++y)
        for (int x = 0; x < 150; ++x) {
            const auto& p = mine.pixels[static_cast<std::size_t>(y) * 150 + x];
            const auto& q = other.at<cv::Vec3f>(y, x);
            EXPECT_EQ(p, glm::vec3(q[2], q[1], q[0])) << x << " " << y;
        }
}

TEST_F(RadianceFile, FlatAndOldRuns) {
    write(header(3, 1) + bytes({128, 64, 0, 129, 255, 1, 2, 128, 9, 9, 9, 0}));
    LinearImage image = readLinearImage(mFile);
    EXPECT_EQ(image.pixels[0], glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(image.pixels[1], glm::vec3(255, 1, 2) / 256.0f);
    EXPECT_EQ(image.pixels[2], glm::vec3(0));
    write(header(5, 1) + bytes({128, 0, 0, 129, 1, 1, 1, 3, 0, 128, 0, 129}));
    image = readLinearImage(mFile);
    for (int x = 0; x < 4; ++x) EXPECT_EQ(image.pixels[x], glm::vec3(1, 0, 0)) << x;
    EXPECT_EQ(image.pixels[4], glm::vec3(0, 1, 0));
    // The second repeat in a row counts 256 times: 1 + 2 + 256.
    write(header(259, 1) + bytes({128, 0, 0, 129, 1, 1, 1, 2, 1, 1, 1, 1}));
    image = readLinearImage(mFile);
    for (int x = 0; x < 259; ++x) EXPECT_EQ(image.pixels[x], glm::vec3(1, 0, 0)) << x;
}

TEST_F(RadianceFile, DamagedFilesAreRefused) {
    const std::string row = bytes({2, 2, 0, 8, 136, 128, 136, 64, 136, 32, 136, 129});
    write(header(8, 1) + row);
    EXPECT_EQ(readLinearImage(mFile).pixels.back(), glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_THAT(errorOf(""), HasSubstr("the file is empty"));
    EXPECT_THAT(errorOf("clouds"), HasSubstr("is not a picture"));
    EXPECT_THAT(errorOf("#?RADIANCE\nFORMAT"), HasSubstr("header: is cut off"));
    EXPECT_THAT(errorOf("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 8\n" + row), HasSubstr("xyze"));
    EXPECT_THAT(errorOf(header(8, 2) + row), HasSubstr("row 2: the picture is cut off"));
    EXPECT_THAT(errorOf(header(8, 2) + row + row.substr(0, 9)), HasSubstr("row 2: the picture is cut off"));
    EXPECT_THAT(errorOf(header(9, 1) + row), HasSubstr("cut off or damaged"));  // another width in the row
    EXPECT_THAT(errorOf(header(8, 1) + bytes({2, 2, 0, 8, 255, 128, 136, 64, 136, 32, 136, 129})),
                HasSubstr("cut off or damaged"));  // a run over the row's end
    EXPECT_THAT(errorOf(header(4, 1) + bytes({1, 1, 1, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})),
                HasSubstr("cut off or damaged"));  // repeats what is not there
    for (const char* size :
         {"-Y 0 +X 8", "-Y 100000 +X 100000", "+Y 1 +X 8", "-Y 8", "-Y 60000 +X 60000", "x"})
        EXPECT_THAT(errorOf("#?RADIANCE\n\n" + std::string(size) + "\n" + row),
                    HasSubstr("size: expected \"-Y height +X width\""))
            << size;
    // A header that claims far more than the bytes can hold is refused before memory is taken.
    EXPECT_THAT(errorOf(header(11000, 11000) + row), HasSubstr("row 1: the picture is cut off"));
}

}  // namespace
}  // namespace stereonav
