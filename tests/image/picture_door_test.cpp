// The door that all pictures come through: what is no picture by its first bytes is refused before a library
// sees it, no decoder but the format's own is asked, sizes are bounded first, and whatever happens in the
// helper that unpacks pictures, or is said by it, is one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/base/file.h"
#include "engine/base/helper_program.h"
#include "engine/base/memory.h"
#include "engine/base/module.h"
#include "engine/image/image_file.h"
#include "engine/image/picture_reader/image_request.h"
#include "tests/support/dicom_files.h"
#include "tests/support/error_of.h"
#include "tests/support/lying_helper.h"
#include "tests/support/picture_bytes.h"

namespace stereonav {
namespace {

using namespace std::string_literals;
using test::encoded;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Plane<PackedColor> decode(const std::string& content) {
    return decodeColorImage({reinterpret_cast<const unsigned char*>(content.data()), content.size()},
                            "a.gltf", "image 0");
}

std::string complaint(const std::string& content) {
    const std::string error = test::errorOf([&] { decode(content); });
    EXPECT_THAT(error, AllOf(testing::StartsWith("a.gltf:image 0: "), Not(HasSubstr("\n"))));
    return error;
}

// Each pixel its own colour.
cv::Mat colours(int width, int height) {
    cv::Mat image(height, width, CV_8UC3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at<cv::Vec3b>(y, x) = {static_cast<unsigned char>(40 * x),
                                         static_cast<unsigned char>(50 * y),
                                         static_cast<unsigned char>(7 * x * y)};
    return image;
}

void expectColours(const Plane<PackedColor>& plane, const cv::Mat& image) {
    ASSERT_EQ(plane.width(), image.cols);
    ASSERT_EQ(plane.height(), image.rows);
    const auto& packed = packedFromSrgbByte();
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x) {
            const auto p = image.at<cv::Vec3b>(y, x);
            ASSERT_EQ(plane.at(x, y),
                      static_cast<PackedColor>(packed[p[2]] | packed[p[1]] << 10 | packed[p[0]] << 20))
                << x << " " << y;
        }
}

// A file like one that ended the program: compressed by RLE, with more segments than there are bytes.
std::string damagedDicom() {
    test::DicomSpec spec;
    spec.slice.columns = spec.slice.rows = 64;
    spec.slice.bitsStored = spec.bits = 8;
    test::DicomBytes bytes(test::DicomSyntax::Explicit);
    std::string packed = bytes.number(0x7fffffff, 4) + bytes.number(64, 4);
    while (packed.size() < 64) packed += bytes.number(9999, 4);
    spec.packed = {packed + std::string(20, '\x81')};
    spec.packedSyntax = "1.2.840.10008.1.2.5";
    return test::dicomBytes(spec);
}

TEST(PictureDoor, WhatIsNoPictureIsRefusedBeforeALibrarySeesIt) {
    const TemporaryFolder empty;
    setModuleFolder(empty / "");  // there is no library: one that was asked would be missed
    for (const std::string& other :
         {damagedDicom(), test::dicomBytes({}), std::string(140, '\0') + "DTED", "P6\n1 1\n255\nabc"s,
          "NITF02.10"s, "\x76\x2f\x31\x01"s, "GIF89a"s, "text"s})
        EXPECT_THAT(complaint(other), HasSubstr("is not a picture of a format that is read here"));
    EXPECT_THAT(complaint(""), HasSubstr("the picture is empty"));
    EXPECT_THAT(test::errorOf([] { decode(encoded(colours(3, 2), ".png")); }),
                HasSubstr("stereonav_picture_reader"));
    setModuleFolder("");
}

// Bytes at those places are what other decoders look for.
TEST(PictureDoor, MarksOfOtherFormatsFurtherOnChangeNothing) {
    const cv::Mat image = colours(60, 5);
    const auto marked = [](std::string file) {
        file.replace(128, 4, "DICM");
        return file.replace(140, 4, "DTED");
    };
    std::string bitmap = marked(encoded(image, ".bmp"));
    cv::Mat changed = image.clone();  // rows from the bottom, behind a head of 54 bytes
    std::copy_n(bitmap.begin() + 54, image.cols * 3, changed.ptr<char>(image.rows - 1));
    expectColours(decode(bitmap), changed);
    expectColours(decode(encoded(image, ".bmp")), image);
    // A chunk of text behind a PNG's head; a comment before a JPEG's first segment.
    std::string png = encoded(image, ".png");
    png.insert(33, "\0\0\0\xc8tEXtKey\0"s + std::string(196, ' ') + "\0\0\0\0"s);  // with a wrong checksum
    expectColours(decode(marked(png)), image);
    const std::string jpeg = encoded(image, ".jpg");
    std::string commented = jpeg;
    commented.insert(2, "\xff\xfe\0\xca"s + std::string(200, ' '));
    const Plane<PackedColor> plain = decode(jpeg), other = decode(marked(commented));
    ASSERT_EQ(other.width(), 60);
    for (int y = 0; y < plain.height(); ++y)
        for (int x = 0; x < plain.width(); ++x) ASSERT_EQ(other.at(x, y), plain.at(x, y));
}

TEST(PictureDoor, DamagedFilesAreNotLeftToAnotherFormatsDecoder) {
    const std::string dicom = test::dicomBytes({});  // whole, for whoever looks for it
    for (const std::string& first :
         {"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x06\0\0\0\x05\x08\x02\0\0\0IEND"s,
          "RIFF\x90\0\0\0WEBPVP8L\x10\0\0\0\x2f\x05\0\x01\0"s,
          "RIFF\x90\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0\x05\0\0\x04\0\0"s,
          "II*\0\x08\0\0\0\x02\0\0\x01\x03\0\x01\0\0\0\x06\0\0\0\x01\x01\x03\0\x01\0\0\0\x05\0\0\0\0\0\0\0"s,
          "BM\0\0\0\0\0\0\0\0\0\0\0\0\x28\0\0\0\x06\0\0\0\x05\0\0\0\x01\0\x63\0"s,
          "\xff\xd8\xff\xc0\0\x0b\x08\0\x05\0\x06\x01\x01\x11\0\xff\xda\xff\xd9"s}) {
        std::string file = dicom;
        file.replace(0, first.size(), first);
        EXPECT_THAT(complaint(file), HasSubstr("is not a picture this program can read"))
            << testing::PrintToString(first.substr(0, 12));
    }
}

TEST(PictureDoor, AllFormatsOfferedAreRead) {
    const cv::Mat image = colours(7, 5);
    for (const char* extension : {".png", ".bmp", ".tif"})
        expectColours(decode(encoded(image, extension)), image);
    expectColours(decode(encoded(image, ".webp", {cv::IMWRITE_WEBP_QUALITY, 101})), image);
    EXPECT_EQ(decode(encoded(image, ".jpg")).width(), 7);
    cv::Mat floats(5, 7, CV_32FC3, cv::Scalar(0.25, 0.5, 4));
    const int plain = 1;  // else TIFF has its own logarithms of floats
    for (const std::string& file :
         {encoded(floats, ".hdr"), encoded(floats, ".tif", {cv::IMWRITE_TIFF_COMPRESSION, plain})})
        EXPECT_EQ(decode(file).at(6, 4), packColor({4, 0.5f, 0.25f}));
    EXPECT_EQ(decode(encoded(floats, ".tif")).width(), 7);
}

// Whatever its name is.
TEST(PictureDoor, TheNameOfAFileIsNotAsked) {
    const TemporaryFolder folder;
    cv::Mat floats(5, 7, CV_32FC3, cv::Scalar(0.25, 0.5, 4));
    writeTextFile(folder / "a.png", encoded(floats, ".hdr"));
    EXPECT_EQ(readLinearImage(folder / "a.png").pixels.at(0), glm::vec3(4, 0.5f, 0.25f));
    writeTextFile(folder / "a.hdr", encoded(colours(7, 5), ".png"));
    expectColours(readColorImage(folder / "a.hdr"), colours(7, 5));
    EXPECT_EQ(readLinearImage(folder / "a.hdr").width, 7);
}

TEST(PictureDoor, APictureThatLiesOnItsSideIsTurned) {
    std::string jpeg = encoded(colours(16, 8), ".jpg");
    jpeg.insert(2,
                "\xff\xe1\0\x22"
                "Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0"s);
    const Plane<PackedColor> turned = decode(jpeg);
    EXPECT_EQ(turned.width(), 8);
    EXPECT_EQ(turned.height(), 16);
}

TEST(PictureDoor, SizesAreBoundedBeforeAnythingIsUnpacked) {
    const auto png = [](std::uint32_t width, std::uint32_t height) {
        std::string file = encoded(colours(3, 2), ".png");
        for (int n = 0; n < 4; ++n) {
            file[16 + static_cast<std::size_t>(n)] = static_cast<char>(width >> (24 - 8 * n));
            file[20 + static_cast<std::size_t>(n)] = static_cast<char>(height >> (24 - 8 * n));
        }
        return file;
    };
    const TemporaryFolder empty;
    setModuleFolder(empty / "");
    for (const auto& [width, height] :
         {std::pair(70000u, 1u), {1u, 70000u}, {60000u, 60000u}, {0u, 5u}, {~0u, ~0u}})
        EXPECT_THAT(complaint(png(width, height)),
                    AllOf(HasSubstr("at most 65536 pixels a side"), HasSubstr(std::to_string(width))));
    limitMemory(1e9);
    EXPECT_THAT(complaint(png(12000, 12000)),
                AllOf(HasSubstr("of memory"), HasSubstr("make the picture smaller")));
    std::string radiance = "#?RADIANCE\n\n-Y 12000 +X 12000\n" + std::string(48000, '\x01');
    EXPECT_THAT(complaint(radiance), AllOf(HasSubstr("of memory"), HasSubstr("make the picture smaller")));
    limitMemory(0);
    setModuleFolder("");
}

// --- a helper that a picture has taken over

std::string answerOf(int width, int height, int sampleBytes, std::size_t bytes) {
    return std::string(bytes, 'a') + test::bytesOfStructure(ImageAnswer{width, height, sampleBytes});
}

std::string complaintAbout(const std::string& said) {
    static int each = 0;  // another folder each time: a helper of its own
    const test::LyingHelper liar("picture_reader", said);
    const std::string png = encoded(colours(6, 5), ".png");
    return test::errorOf([&] {
        decodeColorImage({reinterpret_cast<const unsigned char*>(png.data()), png.size()},
                         "/" + std::to_string(++each) + "/a.png", "");
    });
}

TEST(PictureDoorHelper, MaySayNothingButThePicture) {
    EXPECT_EQ(complaintAbout(test::helperMessage(answerOf(6, 5, 1, 90))), "no error");
    EXPECT_EQ(complaintAbout(test::helperMessage(answerOf(5, 6, 1, 90))), "no error");
    const std::string kAnswers[] = {answerOf(6, 5, 1, 89),  answerOf(6, 5, 2, 90),  answerOf(6, 5, 0, 0),
                                    answerOf(6, 5, 3, 90),  answerOf(6, 5, -1, 90), answerOf(9, 10, 1, 90),
                                    answerOf(1, 30, 1, 90), answerOf(5, 5, 1, 75),  answerOf(-6, -5, 1, 90),
                                    answerOf(6, 5, 1, 0),   answerOf(6, 5, 1, 60),  "",
                                    std::string(11, '\0')};
    for (const std::string& answer : kAnswers)
        EXPECT_THAT(
            complaintAbout(test::helperMessage(answer)),
            AllOf(HasSubstr("a.png: damaged: it is not unpacked to the picture"), Not(HasSubstr("\n"))))
            << testing::PrintToString(answer);
    const std::string good = answerOf(6, 5, 1, 90);
    for (const std::string& said : {test::helperMessage(good, 77), test::helperMessage(good, 0, 1ll << 60),
                                    test::helperMessage(answerOf(6, 5, 4, 360))})
        EXPECT_THAT(complaintAbout(said),
                    HasSubstr("a.png: damaged: the program that unpacks it was ended by it"));
    EXPECT_THAT(complaintAbout(test::helperMessage("\x1b]0;title\x07", 1)), HasSubstr("a.png: ?]0;title?"));
}

TEST(PictureDoorHelper, IsNotWaitedForWithoutEnd) {
    waitForHelpersAtMost(std::chrono::milliseconds(30));
    const std::string good = test::helperMessage(answerOf(6, 5, 1, 90));
    for (const std::size_t said : {std::size_t{0}, std::size_t{3}, good.size() - 1})
        EXPECT_THAT(complaintAbout(good.substr(0, said)), HasSubstr("without an answer"));
    waitForHelpersAtMost(std::chrono::hours(1));
}

TEST(PictureDoorHelper, ItsEndIsOneLineAndTheNextPictureIsRead) {
    const TemporaryFolder folder;
    writeTextFile(folder / "a.png", encoded(colours(7, 5), ".png"));
    {
        const test::LyingHelper dying("picture_reader");
        EXPECT_THAT(test::errorOf([&] { readColorImage(folder / "a.png"); }),
                    AllOf(HasSubstr("a.png: damaged"), HasSubstr("by Killed"), Not(HasSubstr("\n"))));
    }
    expectColours(readColorImage(folder / "a.png"), colours(7, 5));
}

}  // namespace
}  // namespace stereonav
