// What the helper that unpacks DICOM pictures may answer: the picture that was asked for, and nothing else.
#include "colon/study/picture_decoder.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstring>
#include <string>
#include <utility>

#include "colon/study/gdcm/picture_request.h"
#include "tests/support/error_of.h"
#include "tests/support/lying_helper.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kAskedColumns = 6, kAskedRows = 5;
constexpr std::uint64_t kAskedPixels = kAskedColumns * kAskedRows;

std::string pixelAnswer(std::int32_t bits, std::int32_t isSigned, std::size_t bytes) {
    return std::string(bytes, 'a') + test::bytesOfStructure(PictureAnswer{bits, isSigned});
}

TEST(PictureDecoderAnswer, IsTakenWhereEachFieldFits) {
    for (const int bits : {8, 16, 32})
        for (const int isSigned : {0, 1}) {
            const auto pixels = pixelsOf(
                pixelAnswer(bits, isSigned, kAskedPixels * static_cast<std::size_t>(bits / 8)), kAskedPixels);
            ASSERT_TRUE(pixels);
            EXPECT_EQ(pixels->bits, bits);
            EXPECT_EQ(pixels->isSigned, isSigned == 1);
            EXPECT_EQ(pixels->bytes.size(), kAskedPixels * static_cast<std::size_t>(bits / 8));
        }
}

TEST(PictureDecoderAnswer, IsRefusedWhereOneDoesNot) {
    for (int bits = -70; bits < 70; ++bits)
        for (const std::uint64_t bytes : {std::uint64_t{0}, kAskedPixels, kAskedPixels + 1, 2 * kAskedPixels,
                                          3 * kAskedPixels, 4 * kAskedPixels}) {
            const bool fits = (bits == 8 && bytes == kAskedPixels) ||
                              (bits == 16 && bytes == 2 * kAskedPixels) ||
                              (bits == 32 && bytes == 4 * kAskedPixels);
            EXPECT_EQ(pixelsOf(pixelAnswer(bits, 0, bytes), kAskedPixels).has_value(), fits)
                << bits << " " << bytes;
        }
    for (const int isSigned : {-1, 2, 256})
        EXPECT_FALSE(pixelsOf(pixelAnswer(8, isSigned, kAskedPixels), kAskedPixels));
    EXPECT_FALSE(pixelsOf("", kAskedPixels));
    EXPECT_FALSE(pixelsOf(std::string(sizeof(PictureAnswer) - 1, '\0'), kAskedPixels));
}

// Returns the complaint about a picture whose helper answers so.
std::string pixelComplaint(const std::string& said) {
    const test::LyingHelper liar("gdcm", said);
    PictureDecoder decoder;
    PackedPicture picture{"a.dcm",   "1.2.840.10008.1.2.5", kAskedColumns, kAskedRows, 16, 16, 15, false,
                          {"packed"}};
    return test::errorOf([&] { decoder.decode(picture); });
}

TEST(PictureDecoderHelper, MaySayNothingButAPicture) {
    EXPECT_EQ(pixelComplaint(test::helperMessage(pixelAnswer(16, 0, 2 * kAskedPixels))), "no error");
    for (const int bits : {0, 1, 7, 9, 12, 15, 17, 24, 31, 33, 64, -8, -16})
        for (const std::uint64_t bytes : {kAskedPixels, 2 * kAskedPixels})
            EXPECT_THAT(pixelComplaint(test::helperMessage(pixelAnswer(bits, 0, bytes))),
                        AllOf(HasSubstr("a.dcm: damaged: its pixels"), Not(HasSubstr("\n"))))
                << bits;
    const std::string good = pixelAnswer(16, 0, 2 * kAskedPixels);
    for (const std::string& said : {test::helperMessage(good, 77), test::helperMessage(good, 0, 1ll << 60)})
        EXPECT_THAT(pixelComplaint(said),
                    HasSubstr("a.dcm: damaged: the program that decodes its pixels was ended"));
    EXPECT_THAT(pixelComplaint(test::helperMessage("\x1b[31m", 1)), HasSubstr("a.dcm: ?[31m"));
}

TEST(PictureDecoderHelper, IsNotWaitedForWithoutEnd) {
    waitForHelpersAtMost(std::chrono::milliseconds(30));
    const std::string good = test::helperMessage(pixelAnswer(16, 0, 2 * kAskedPixels));
    for (const std::size_t said : {std::size_t{0}, std::size_t{3}, good.size() - 1})
        EXPECT_THAT(pixelComplaint(good.substr(0, said)), HasSubstr("a.dcm: damaged: the program"));
    waitForHelpersAtMost(std::chrono::hours(1));
}

TEST(PictureDecoderHelper, ItsEndIsOneLine) {
    const test::LyingHelper dying("gdcm");
    PictureDecoder decoder;
    PackedPicture picture{"a.dcm",   "1.2.840.10008.1.2.5", kAskedColumns, kAskedRows, 16, 16, 15, false,
                          {"packed"}};
    EXPECT_THAT(test::errorOf([&] { decoder.decode(picture); }),
                AllOf(HasSubstr("a.dcm: damaged"), HasSubstr("by Killed"), Not(HasSubstr("\n"))));
}

}  // namespace
}  // namespace stereonav
