// Files for 3D viewers, read back byte by byte as their descriptions say, and their pictures by OpenCV.
#include "engine/image/stereo_picture_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "engine/base/error.h"
#include "engine/image/image_file.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {
namespace {

using PictureBytes = std::vector<unsigned char>;

// Reads as written in TIFF: most significant byte first.
std::uint32_t bigAt(const PictureBytes& bytes, std::size_t at, int count) {
    std::uint32_t value = 0;
    for (int n = 0; n < count; ++n) value = value << 8 | bytes.at(at + static_cast<std::size_t>(n));
    return value;
}
std::string textAt(const PictureBytes& bytes, std::size_t at, std::size_t count) {
    EXPECT_LE(at + count, bytes.size());
    return {bytes.begin() + static_cast<std::ptrdiff_t>(at),
            bytes.begin() + static_cast<std::ptrdiff_t>(at + count)};
}

// Markers with the places of their content, from a picture's start up to its first scan.
std::vector<std::pair<std::uint32_t, std::size_t>> segmentsFrom(const PictureBytes& bytes,
                                                                std::size_t start) {
    EXPECT_EQ(bigAt(bytes, start, 2), 0xFFD8u);
    std::vector<std::pair<std::uint32_t, std::size_t>> segments;
    for (std::size_t at = start + 2; at + 4 < bytes.size();) {
        const std::uint32_t marker = bigAt(bytes, at, 2);
        EXPECT_EQ(marker >> 8, 0xFFu);
        segments.emplace_back(marker, at + 4);
        if (marker == 0xFFDA) break;
        at += 2 + bigAt(bytes, at + 2, 2);
    }
    return segments;
}
std::size_t segmentOf(const PictureBytes& bytes, std::size_t start, std::uint32_t marker) {
    for (const auto& [found, at] : segmentsFrom(bytes, start))
        if (found == marker) return at;
    ADD_FAILURE() << "no segment " << std::hex << marker;
    return 0;
}

struct TiffField {
    std::uint32_t type = 0, count = 0;
    std::size_t at = 0;  // place of its value
};
struct TiffDirectory {
    std::map<std::uint32_t, TiffField> fields;
    std::uint32_t next = 0;
};

TiffDirectory directoryAt(const PictureBytes& bytes, std::size_t order, std::uint32_t offset) {
    TiffDirectory directory;
    const std::size_t start = order + offset;
    const std::uint32_t count = bigAt(bytes, start, 2);
    std::uint32_t last = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::size_t at = start + 2 + 12 * n;
        const std::uint32_t tag = bigAt(bytes, at, 2), type = bigAt(bytes, at + 2, 2);
        EXPECT_GT(tag, last) << "tags rise";
        last = tag;
        const std::uint32_t sizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8}, many = bigAt(bytes, at + 4, 4);
        const bool inside = sizes[type] * many <= 4;
        directory.fields[tag] = {type, many, inside ? at + 8 : order + bigAt(bytes, at + 8, 4)};
    }
    directory.next = bigAt(bytes, start + 2 + 12 * count, 4);
    return directory;
}

Plane<PackedColor> eyeOf(int width, int height, std::uint32_t level) {
    Plane<PackedColor> eye(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) eye.at(x, y) = level | level << 10 | level << 20;
    return eye;
}

int byteAt(const Plane<PackedColor>& picture, int x, int y) {
    return srgbByteFromPacked()[picture.at(x, y) >> 10 & 1023u];
}

TEST(StereoPictureFile, NamesAreKnownByTheirExtension) {
    EXPECT_TRUE(isJps("a.jps"));
    EXPECT_TRUE(isJps("b/A.JPS"));
    EXPECT_TRUE(isMpo("a.Mpo"));
    EXPECT_FALSE(isJps("jps"));
    EXPECT_FALSE(isMpo("a.mpo.png"));
}

TEST(StereoPictureFile, AJpsHasTheRightEyeOnTheLeftAndSaysSo) {
    const Plane<PackedColor> left = eyeOf(24, 16, 300), right = eyeOf(24, 16, 900);
    const PictureBytes bytes = jpsBytes(composeStereo(left, right, {OutputMode::CrossEyed, false, false}));
    EXPECT_EQ(segmentsFrom(bytes, 0).front().first, 0xFFE0u) << "JFIF's segment stays the first one";
    const std::size_t said = segmentOf(bytes, 0, 0xFFE3);
    EXPECT_EQ(bigAt(bytes, said - 2, 2), 2u + 8 + 2 + 4 + 2) << "its length";
    EXPECT_EQ(textAt(bytes, said, 8), "_JPSJPS_");
    EXPECT_EQ(bigAt(bytes, said + 8, 2), 4u);
    EXPECT_EQ(bytes.at(said + 10), 0) << "separation";
    EXPECT_EQ(bytes.at(said + 11), 0) << "neither half: and the right eye first";
    EXPECT_EQ(bytes.at(said + 12), 2) << "side by side";
    EXPECT_EQ(bytes.at(said + 13), 1) << "stereoscopic";
    EXPECT_EQ(bigAt(bytes, said + 14, 2), 0u) << "no comment";
    const Plane<PackedColor> read = decodeColorImage(bytes, "a.jps", "");
    ASSERT_EQ(read.width(), 48);
    ASSERT_EQ(read.height(), 16);
    EXPECT_NEAR(byteAt(read, 8, 8), byteAt(right, 0, 0), 3);
    EXPECT_NEAR(byteAt(read, 40, 8), byteAt(left, 0, 0), 3);
}

TEST(StereoPictureFile, AMpoHasBothEyesWithTheirIndex) {
    const Plane<PackedColor> left = eyeOf(33, 21, 300), right = eyeOf(33, 21, 900);
    const PictureBytes bytes = mpoBytes(left, right, {0.065, 0});
    const auto segments = segmentsFrom(bytes, 0);
    ASSERT_GT(segments.size(), 3u);
    EXPECT_EQ(segments[0].first, 0xFFE1u);
    EXPECT_EQ(segments[1].first, 0xFFE2u);
    for (const auto& [marker, at] : segments) EXPECT_NE(marker, 0xFFE0u) << "JFIF beside Exif";

    const std::size_t mpf = segments[1].second, order = mpf + 4;
    EXPECT_EQ(textAt(bytes, mpf, 4), std::string("MPF\0", 4));
    EXPECT_EQ(textAt(bytes, order, 4), std::string("MM\0*", 4));
    const TiffDirectory index = directoryAt(bytes, order, bigAt(bytes, order + 4, 4));
    EXPECT_EQ(textAt(bytes, index.fields.at(0xB000).at, 4), "0100");
    EXPECT_EQ(bigAt(bytes, index.fields.at(0xB001).at, 4), 2u);
    const TiffField entries = index.fields.at(0xB002);
    ASSERT_EQ(entries.count, 32u);
    EXPECT_EQ(entries.type, 7u);
    EXPECT_EQ(bigAt(bytes, entries.at, 4), 0x20020002u) << "disparity, shown where one is";
    EXPECT_EQ(bigAt(bytes, entries.at + 16, 4), 0x00020002u);
    const std::uint32_t first = bigAt(bytes, entries.at + 4, 4), second = bigAt(bytes, entries.at + 20, 4);
    EXPECT_EQ(bigAt(bytes, entries.at + 8, 4), 0u) << "the first one's place";
    const std::size_t other = order + bigAt(bytes, entries.at + 24, 4);
    EXPECT_EQ(other, first);
    EXPECT_EQ(first + second, bytes.size());
    EXPECT_EQ(bigAt(bytes, first - 2, 2), 0xFFD9u) << "the first one's end";

    const TiffDirectory own = directoryAt(bytes, order, index.next);
    EXPECT_EQ(own.next, 0u);
    EXPECT_EQ(bigAt(bytes, own.fields.at(0xB101).at, 4), 1u);
    const std::size_t otherMpf = segmentOf(bytes, other, 0xFFE2);
    const TiffDirectory eye = directoryAt(bytes, otherMpf + 4, bigAt(bytes, otherMpf + 8, 4));
    EXPECT_EQ(textAt(bytes, eye.fields.at(0xB000).at, 4), "0100");
    EXPECT_EQ(bigAt(bytes, eye.fields.at(0xB101).at, 4), 2u);
    EXPECT_EQ(bigAt(bytes, eye.fields.at(0xB204).at, 4), 1u) << "measured against the left one";
    const std::size_t base = eye.fields.at(0xB206).at;
    EXPECT_DOUBLE_EQ(static_cast<double>(bigAt(bytes, base, 4)) / bigAt(bytes, base + 4, 4), 0.065);

    for (const std::size_t start : {std::size_t{0}, other}) {
        const std::size_t exif = segmentOf(bytes, start, 0xFFE1), tiff = exif + 6;
        EXPECT_EQ(textAt(bytes, exif, 6), std::string("Exif\0\0", 6));
        const TiffDirectory basics = directoryAt(bytes, tiff, bigAt(bytes, tiff + 4, 4));
        const TiffDirectory more = directoryAt(bytes, tiff, bigAt(bytes, basics.fields.at(0x8769).at, 4));
        EXPECT_EQ(bigAt(bytes, more.fields.at(0xA002).at, 4), 33u);
        EXPECT_EQ(bigAt(bytes, more.fields.at(0xA003).at, 4), 21u);
    }

    const Plane<PackedColor> readLeft = decodeColorImage({bytes.data(), first}, "a.mpo", "left"),
                             readRight = decodeColorImage({bytes.data() + first, second}, "a.mpo", "right");
    EXPECT_EQ(readLeft.width(), 33);
    EXPECT_EQ(readRight.height(), 21);
    EXPECT_NEAR(byteAt(readLeft, 5, 5), byteAt(left, 0, 0), 2);
    EXPECT_NEAR(byteAt(readRight, 5, 5), byteAt(right, 0, 0), 2);
}

TEST(StereoPictureFile, DistancesOfAnySizeAreToldOrUnknown) {
    const auto toldAs = [](double separation) {
        const PictureBytes jpeg{0xFF, 0xD8, 0xFF, 0xD9};
        const PictureBytes bytes = mpoFromJpegs(jpeg, jpeg, 1, 1, {separation, 0});
        const std::size_t mpf = segmentOf(bytes, 0, 0xFFE2);
        const TiffDirectory index = directoryAt(bytes, mpf + 4, bigAt(bytes, mpf + 8, 4));
        const std::size_t other = bigAt(bytes, index.fields.at(0xB002).at + 4, 4);
        const std::size_t own = segmentOf(bytes, other, 0xFFE2);
        const TiffDirectory eye = directoryAt(bytes, own + 4, bigAt(bytes, own + 8, 4));
        const std::size_t at = eye.fields.at(0xB206).at;
        return std::pair(bigAt(bytes, at, 4), bigAt(bytes, at + 4, 4));
    };
    for (const double known : {0.0, 1e-8, 0.065, 25.0, 3e5, 3.9e9}) {
        const auto [above, below] = toldAs(known);
        EXPECT_NEAR(static_cast<double>(above) / below, known, 1e-8 * known + 1e-9) << known;
    }
    for (const double unknown :
         {-1.0, 1e10, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_EQ(toldAs(unknown), std::pair(0xFFFFFFFFu, 0xFFFFFFFFu)) << unknown;
}

TEST(StereoPictureFile, WhatIsNoJpegAndEyesOfTwoSizesAreRefused) {
    EXPECT_THROW(jpsFromJpeg(PictureBytes{1, 2, 3, 4}), Error);
    EXPECT_THROW(jpsFromJpeg(PictureBytes{}), Error);
    EXPECT_THROW(jpsFromJpeg(PictureBytes{0xFF, 0xD8, 0xFF, 0xE0, 0x10, 0x00}), Error);
    EXPECT_THROW(mpoBytes(eyeOf(4, 4, 0), eyeOf(4, 5, 0), {}), Error);
}

}  // namespace
}  // namespace stereonav
