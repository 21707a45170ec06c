// Picture files: what is written is read back, what can not be read is said in one line.
#include "engine/image/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ImageFile : public testing::Test {
protected:
    void SetUp() override {
        mFolder = fs::temp_directory_path() / ("stereonav-image-test-" + std::to_string(getpid()));
        fs::create_directories(mFolder);
    }
    void TearDown() override { fs::remove_all(mFolder); }
    fs::path in(const std::string& name) const { return mFolder / name; }

    // The message of reading `name`, "" when it was read.
    std::string complaint(const std::string& name) const {
        try {
            readColorImage(in(name));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

private:
    fs::path mFolder;
};

Plane<PackedColor> testPicture(int width, int height) {
    Plane<PackedColor> picture(width, height);
    const auto& packed = packedFromSrgbByte();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.at(x, y) = static_cast<PackedColor>(packed[(x * 5) % 256] | packed[(y * 3) % 256] << 10 |
                                                        packed[(x * y) % 256] << 20);
    return picture;
}

TEST_F(ImageFile, PngBringsBackEveryByte) {
    const auto picture = testPicture(61, 90);
    writeColorImage(in("a.png"), picture);
    const auto back = readColorImage(in("a.png"));
    ASSERT_EQ(back.width(), 61);
    ASSERT_EQ(back.height(), 90);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 61; ++x) ASSERT_EQ(back.at(x, y), picture.at(x, y)) << x << ", " << y;
}

// What we write without a library against what OpenCV's reads, at every kind of row: noise, flat, a ramp.
TEST_F(ImageFile, PngIsReadBackByOpenCvWithEveryByte) {
    for (const auto& [width, height] : {std::pair(1, 1), {1, 40}, {40, 1}, {33, 17}, {640, 48}}) {
        Plane<PackedColor> picture(width, height);
        std::uint32_t noise = 1;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                noise = noise * 1664525u + 1013904223u;
                const std::uint32_t ramp = static_cast<std::uint32_t>(x + y) & 1023u;
                picture.at(x, y) = y % 3 == 0   ? noise >> 2
                                   : y % 3 == 1 ? 0x12345678u & 0x3fffffffu
                                                : ramp * 0x100401u;
            }
        const auto bytes = encodeColorImage(picture, ".png");
        const cv::Mat back = cv::imdecode(bytes, cv::IMREAD_COLOR);
        ASSERT_EQ(back.cols, width);
        ASSERT_EQ(back.rows, height);
        const auto& table = srgbByteFromPacked();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const PackedColor c = picture.at(x, y);
                const cv::Vec3b bgr(table[c >> 20 & 1023], table[c >> 10 & 1023], table[c & 1023]);
                ASSERT_EQ(back.at<cv::Vec3b>(y, x), bgr)
                    << width << "x" << height << " at " << x << ", " << y;
            }
    }
}

TEST_F(ImageFile, APictureOfNoPixelsIsRefused) {
    EXPECT_THROW(writeColorImage(in("none.png"), Plane<PackedColor>()), Error);
    EXPECT_TRUE(std::filesystem::is_empty(in("")));
}

TEST_F(ImageFile, RowZeroIsTheTopAndRedIsRed) {
    cv::Mat mat(2, 3, CV_8UC3, cv::Scalar(0, 0, 0));
    mat.at<cv::Vec3b>(0, 2) = {0, 0, 255};  // blue, green, red
    cv::imwrite(in("a.png").string(), mat);
    const auto back = readColorImage(in("a.png"));
    EXPECT_EQ(back.at(2, 0), packColor({1, 0, 0}));
    EXPECT_EQ(back.at(2, 1), 0u);
}

TEST_F(ImageFile, SixteenBitGrayKeepsItsFineSteps) {
    cv::Mat mat(1, 4, CV_16U);
    for (int x = 0; x < 4; ++x) mat.at<std::uint16_t>(0, x) = static_cast<std::uint16_t>(40000 + 60 * x);
    cv::imwrite(in("a.png").string(), mat);
    const auto linear = readLinearImage(in("a.png"));
    ASSERT_EQ(linear.width, 4);
    for (int x = 0; x < 4; ++x) {
        const float expected = linearFromSrgb(static_cast<float>(40000 + 60 * x) / 65535.0f);
        EXPECT_NEAR(linear.pixels[x].x, expected, 1e-5f);
        EXPECT_EQ(linear.pixels[x].x, linear.pixels[x].z);
    }
}

TEST_F(ImageFile, RadianceIsLinearAndNotClamped) {
    cv::Mat mat(2, 2, CV_32FC3, cv::Scalar(0.25f, 1.0f, 3504.0f));
    cv::imwrite(in("a.hdr").string(), mat);
    const auto linear = readLinearImage(in("a.hdr"));
    ASSERT_EQ(linear.pixels.size(), 4u);
    // One exponent for three channels of 8 bits: a step is 1/128 of the greatest.
    EXPECT_NEAR(linear.pixels[3].x, 3504.0f, 3504.0f / 128);
    EXPECT_NEAR(linear.pixels[3].z, 0.25f, 3504.0f / 128);
    EXPECT_EQ(readColorImage(in("a.hdr")).at(0, 0) & 1023u, 1023u);
}

TEST_F(ImageFile, JpegIsReadToo) {
    writeColorImage(in("a.jpg"), Plane<PackedColor>(64, 48));
    EXPECT_EQ(readColorImage(in("a.jpg")).width(), 64);
}

TEST_F(ImageFile, MissingEmptyAndForeignFilesAreNamed) {
    EXPECT_THAT(complaint("absent.png"), HasSubstr("absent.png"));
    writeTextFile(in("empty.png"), "");
    EXPECT_THAT(complaint("empty.png"), HasSubstr("empty.png: the file is empty"));
    writeTextFile(in("text.png"), "this is no picture");
    EXPECT_THAT(complaint("text.png"), HasSubstr("text.png: is not a picture"));
    EXPECT_THAT(complaint("text.png"), Not(HasSubstr("\n")));
}

TEST_F(ImageFile, CutOffPngIsRefused) {
    writeColorImage(in("whole.png"), testPicture(200, 200));
    const std::string bytes = readTextFile(in("whole.png"));
    for (const std::size_t kept : {std::size_t{4}, std::size_t{30}, bytes.size() / 2, bytes.size() - 20}) {
        writeTextFile(in("cut.png"), bytes.substr(0, kept));
        EXPECT_THAT(complaint("cut.png"), HasSubstr("cut.png")) << kept << " of " << bytes.size() << " bytes";
    }
}

TEST_F(ImageFile, CutOffJpegIsRefused) {
    writeColorImage(in("whole.jpg"), testPicture(200, 200));
    const std::string bytes = readTextFile(in("whole.jpg"));
    for (const std::size_t kept : {std::size_t{4}, bytes.size() / 2, bytes.size() - 20}) {
        writeTextFile(in("cut.jpg"), bytes.substr(0, kept));
        EXPECT_THAT(complaint("cut.jpg"), HasSubstr("cut.jpg")) << kept << " of " << bytes.size() << " bytes";
    }
}

TEST_F(ImageFile, UnknownExtensionIsRefusedAndLeavesNothing) {
    EXPECT_THROW(writeColorImage(in("a.xyz"), Plane<PackedColor>(4, 4)), Error);
    EXPECT_THROW(writeColorImage(in("a"), Plane<PackedColor>(4, 4)), Error);
    EXPECT_TRUE(fs::is_empty(in("")));
}

}  // namespace
}  // namespace stereonav
