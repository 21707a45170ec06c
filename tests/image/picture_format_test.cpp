// What the first bytes and the head of a picture file say, held against what OpenCV wrote, and against files
// that are written out by hand where it writes none.
#include "engine/image/picture_format.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/support/picture_bytes.h"

namespace stereonav {
namespace {

using namespace std::string_literals;
using test::encoded;

void expectHead(const std::string& content, PictureFormat format, long long width, long long height,
                int sampleBytes = 1) {
    ASSERT_EQ(pictureFormatOf(content), format);
    const auto head = pictureHeadOf(format, content);
    ASSERT_TRUE(head);
    EXPECT_EQ(head->width, width);
    EXPECT_EQ(head->height, height);
    EXPECT_EQ(head->sampleBytes, sampleBytes);
}

TEST(PictureFormat, IsToldByTheFirstBytesAlone) {
    EXPECT_EQ(pictureFormatOf("#?RADIANCE\n"), PictureFormat::Radiance);
    EXPECT_EQ(pictureFormatOf("RIFF\x10\0\0\0WEBPVP8 "s), PictureFormat::WebP);
    // Others that libraries behind a picture reader know: PNM, PFM, Sun, JPEG 2000, OpenEXR, NITF, GIF, PDF.
    const std::string kOthers[] = {std::string(128, '\0') + "DICM",
                                   std::string(140, '\0') + "DTED",
                                   "P6\n1 1\n255\nabc",
                                   "PF\n1 1\n-1\n",
                                   "\x59\xa6\x6a\x95",
                                   "\0\0\0\x0cjP  \r\n\x87\n"s,
                                   "\xff\x4f\xff\x51",
                                   "\x76\x2f\x31\x01",
                                   "NITF02.10",
                                   "GIF89a",
                                   "%PDF-1.4",
                                   "RIFF\x10\0\0\0WAVEfmt "s,
                                   "RIFF",
                                   "\x89PNG\r\n",
                                   "\x89PNG\n\n\x1a\n",
                                   "\xff\xd8",
                                   "II*",
                                   "MM*\0"s,
                                   " BM",
                                   "B",
                                   ""};
    for (const std::string& other : kOthers)
        EXPECT_FALSE(pictureFormatOf(other)) << testing::PrintToString(other);
}

TEST(PictureHeads, AreThoseThatOpenCvWrites) {
    for (const auto& [width, height] : {std::pair(1, 1), {3, 2}, {61, 90}, {300, 7}}) {
        const cv::Mat bytes(height, width, CV_8UC3, cv::Scalar(10, 20, 30)),
            words(height, width, CV_16UC3, cv::Scalar(10, 20, 30)),
            floats(height, width, CV_32FC3, cv::Scalar(0.1, 0.2, 0.3)),
            gray(height, width, CV_8U, cv::Scalar(9)),
            withAlpha(height, width, CV_8UC4, cv::Scalar(10, 20, 30, 40));
        expectHead(encoded(bytes, ".png"), PictureFormat::Png, width, height);
        expectHead(encoded(words, ".png"), PictureFormat::Png, width, height, 2);
        expectHead(encoded(gray, ".jpg"), PictureFormat::Jpeg, width, height);
        expectHead(
            encoded(bytes, ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1, cv::IMWRITE_JPEG_RST_INTERVAL, 1}),
            PictureFormat::Jpeg, width, height);
        expectHead(encoded(bytes, ".bmp"), PictureFormat::Bmp, width, height);
        expectHead(encoded(gray, ".bmp"), PictureFormat::Bmp, width, height);
        expectHead(encoded(bytes, ".tif"), PictureFormat::Tiff, width, height);
        expectHead(encoded(words, ".tif"), PictureFormat::Tiff, width, height, 2);
        expectHead(encoded(floats, ".tif"), PictureFormat::Tiff, width, height, 4);
        expectHead(encoded(bytes, ".webp", {cv::IMWRITE_WEBP_QUALITY, 50}), PictureFormat::WebP, width,
                   height);
        expectHead(encoded(bytes, ".webp", {cv::IMWRITE_WEBP_QUALITY, 101}), PictureFormat::WebP, width,
                   height);
        expectHead(encoded(withAlpha, ".webp", {cv::IMWRITE_WEBP_QUALITY, 50}), PictureFormat::WebP, width,
                   height);
    }
}

TEST(PictureHeads, OfTiffInBothOrdersAndOfBigTiff) {
    const std::string little =
        "II*\0\x08\0\0\0\x02\0"
        "\0\x01\x03\0\x01\0\0\0\x05\0\0\0"
        "\x01\x01\x04\0\x01\0\0\0\x03\0\0\0\0\0\0\0"s;
    expectHead(little, PictureFormat::Tiff, 5, 3);
    const std::string big =
        "MM\0*\0\0\0\x08\0\x03"
        "\x01\0\0\x03\0\0\0\x01\0\x05\0\0"
        "\x01\x01\0\x04\0\0\0\x01\0\0\0\x03"
        "\x01\x02\0\x03\0\0\0\x01\0\x10\0\0\0\0\0\0"s;
    expectHead(big, PictureFormat::Tiff, 5, 3, 2);
    const std::string long8 =
        "II+\0\x08\0\0\0\x10\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0"
        "\0\x01\x10\0\x01\0\0\0\0\0\0\0\x05\0\0\0\x01\0\0\0"
        "\x01\x01\x03\0\x01\0\0\0\0\0\0\0\x03\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"s;
    expectHead(long8, PictureFormat::Tiff, 0x100000005ll, 3);
    EXPECT_FALSE(isPictureSize(0x100000005ll, 3));
}

TEST(PictureHeads, OfBitmapsFromTheTopAndOfTheOldKind) {
    std::string windows = "BM"s + std::string(12, '\0') + "\x28\0\0\0\x05\0\0\0\xfd\xff\xff\xff"s;
    expectHead(windows, PictureFormat::Bmp, 5, 3);
    expectHead("BM"s + std::string(12, '\0') + "\x0c\0\0\0\x05\0\x03\0"s, PictureFormat::Bmp, 5, 3);
    windows.replace(22, 4, "\0\0\0\x80"s);
    expectHead(windows, PictureFormat::Bmp, 5, 1ll << 31);
}

// Segments that look like frames inside, bytes between segments, and markers that stand alone.
TEST(PictureHeads, OfJpegsBehindOtherSegments) {
    const std::string frame = "\xff\xc2\0\x0b\x08\0\x03\0\x05\x01\x01\x11\0"s;
    const std::string inside = "\xff\xe1\0\x0c\xff\xc0\0\x0b\x08\x11\x11\x22\x22\x01"s;
    expectHead("\xff\xd8"s + inside + frame, PictureFormat::Jpeg, 5, 3);
    expectHead("\xff\xd8\xff\xff\xff\xfe\0\x04zz"s + frame, PictureFormat::Jpeg, 5, 3);
    expectHead("\xff\xd8\xff\x01\xff\xd0??"s + "\xff\xc4\0\x03z"s + frame, PictureFormat::Jpeg, 5, 3);
    EXPECT_FALSE(pictureHeadOf(PictureFormat::Jpeg, "\xff\xd8\xff\xda\0\x02"s + frame));
    EXPECT_FALSE(pictureHeadOf(PictureFormat::Jpeg, "\xff\xd8\xff\xd9"s + frame));
}

// No byte more is read than there is (a sanitizer's matter), and nothing is taken for a size that is none.
TEST(PictureHeads, CutOffAnywhereSayNothingElse) {
    const cv::Mat bytes(7, 9, CV_8UC3, cv::Scalar(10, 20, 30));
    for (const char* extension : {".png", ".jpg", ".bmp", ".tif", ".webp"}) {
        const std::string whole = encoded(bytes, extension);
        const PictureFormat format = pictureFormatOf(whole).value();
        const PictureHead truth = pictureHeadOf(format, whole).value();
        for (std::size_t kept = 0; kept < whole.size(); ++kept) {
            const std::string cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept));
            const auto head = pictureHeadOf(format, cut);
            if (!head || !isPictureSize(head->width, head->height)) continue;
            EXPECT_EQ(head->width, truth.width) << extension << " " << kept;
            EXPECT_EQ(head->height, truth.height) << extension << " " << kept;
        }
    }
}

TEST(PictureSizes, AreBounded) {
    EXPECT_TRUE(isPictureSize(1, 1));
    EXPECT_TRUE(isPictureSize(65536, 4096));
    EXPECT_TRUE(isPictureSize(16384, 16384));
    for (const auto& [width, height] : {std::pair<long long, long long>(0, 1),
                                        {1, 0},
                                        {-1, -1},
                                        {65537, 1},
                                        {1, 65537},
                                        {16384, 16385},
                                        {1ll << 32, 1ll << 32},
                                        {1ll << 62, 1ll << 62}})
        EXPECT_FALSE(isPictureSize(width, height)) << width << " " << height;
}

}  // namespace
}  // namespace stereonav
