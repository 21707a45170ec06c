#include "tests/combinations/small_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>

#include "engine/image/image_file.h"
#include "tests/support/volume_files.h"

namespace stereonav::test {
namespace {

double hillAt(int i, int j) {
    return 120 + 40 * std::sin(0.45 * i) * std::cos(0.37 * j + 0.5) + 12 * std::sin(1.3 * i + 0.9 * j);
}

std::string grid(const glm::ivec3& size, const std::function<double(int, int, int)>& value, bool bytes) {
    std::string samples;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const auto v = static_cast<std::int16_t>(std::lround(value(i, j, k)));
                samples += static_cast<char>(v & 255);
                if (!bytes) samples += static_cast<char>(v >> 8 & 255);
            }
    return samples;
}

// HU: air around, soft tissue, a bone across, a hollow.
constexpr int kBodySide = 26;
double bodyAt(int i, int j, int k) {
    const double x = i - 12.5, y = j - 12.5, z = k - 12.5;
    if (std::hypot(x / 10, y / 9, z / 11) > 1) return -1000;
    if (std::hypot(x + 4, y - 2, z) < 3) return -1000;
    return std::hypot(x - 3, y - 1) < 2.5 ? 900 : 40 + 5 * std::sin(x) * std::cos(y + z);
}

template <typename T>
void put(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void putEntry(std::string& bytes, std::uint16_t tag, std::uint16_t type, std::uint32_t count,
              std::uint32_t value) {
    put(bytes, tag);
    put(bytes, type);
    put(bytes, count);
    put(bytes, value);
}

}  // namespace

void writeHills(const std::string& file) {
    std::ostringstream text;
    text << "ncols 32\nnrows 24\nxllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value -9999\n";
    for (int j = 0; j < 24; ++j, text << '\n')
        for (int i = 0; i < 32; ++i)
            text << (i > 18 && i < 22 && j > 9 && j < 13 ? -9999.0 : hillAt(i, j)) << ' ';
    writeBytes(file, text.str());
}

// TIFF 6.0 with GeoTIFF's pixel scale and tie point: one strip of floats.
void writeReliefTiff(const std::string& file) {
    constexpr std::uint32_t kWidth = 33, kHeight = 29, kEntries = 12;
    constexpr std::uint16_t kShort = 3, kLong = 4, kDouble = 12;
    constexpr std::uint32_t kScale = 8 + 2 + kEntries * 12 + 4, kTie = kScale + 24, kSamples = kTie + 48;
    std::string bytes("II*\0", 4);
    put<std::uint32_t>(bytes, 8);
    put<std::uint16_t>(bytes, kEntries);
    putEntry(bytes, 256, kLong, 1, kWidth);
    putEntry(bytes, 257, kLong, 1, kHeight);
    putEntry(bytes, 258, kShort, 1, 32);
    putEntry(bytes, 259, kShort, 1, 1);
    putEntry(bytes, 262, kShort, 1, 1);
    putEntry(bytes, 273, kLong, 1, kSamples);
    putEntry(bytes, 277, kShort, 1, 1);
    putEntry(bytes, 278, kLong, 1, kHeight);
    putEntry(bytes, 279, kLong, 1, kWidth * kHeight * 4);
    putEntry(bytes, 339, kShort, 1, 3);
    putEntry(bytes, 33550, kDouble, 3, kScale);
    putEntry(bytes, 33922, kDouble, 6, kTie);
    put<std::uint32_t>(bytes, 0);
    for (const double v : {20.0, 20.0, 0.0}) put(bytes, v);
    for (const double v : {0.0, 0.0, 0.0, 5000.0, 9000.0, 0.0}) put(bytes, v);
    for (int j = 0; j < static_cast<int>(kHeight); ++j)
        for (int i = 0; i < static_cast<int>(kWidth); ++i)
            put(bytes, static_cast<float>(1.5 * hillAt(j, i) + 300));
    writeBytes(file, bytes);
}

void writeBalls(const std::string& file) {
    const auto value = [](int i, int j, int k) {
        return std::max({0.0, 1000 - 100 * std::hypot(i - 7.5, j - 11.5, k - 11.5),
                         1000 - 100 * std::hypot(i - 15.5, j - 11.5, k - 11.5)});
    };
    writeNrrd(file,
              "type: short\ndimension: 3\nsizes: 24 24 24\nspace: left-posterior-superior\n"
              "space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (-24,-24,-24)\nencoding: raw\n"
              "endian: little\n",
              grid({24, 24, 24}, value, false));
}

void writeBody(const std::string& file) {
    const glm::ivec3 size(kBodySide);
    writeBytes(file, gzipped(niftiBytes(size, {2, 2, 2.5}, {-25, -25, -30}, DT_SIGNED_SHORT, 16,
                                        grid(size, bodyAt, false))));
}

void writeMask(const std::string& file) {
    const auto value = [](int i, int j, int k) {
        const bool block = i > 2 && i < 21 && j > 2 && j < 17 && k > 2 && k < 19;
        return block && std::hypot(i - 12.0, k - 10.0) > 4 ? 1 : 0;
    };
    writeMeta(file, "DimSize = 24 20 22\nElementType = MET_UCHAR\nElementSpacing = 2 2 2\nOffset = 0 0 0\n",
              grid({24, 20, 22}, value, true));
}

void writeSlices(const std::string& folder) {
    for (int k = 0; k < kBodySide; ++k) {
        SliceSpec slice;
        slice.columns = slice.rows = kBodySide;
        slice.spacing = {2, 2};
        slice.position = {-25, -25, -30 + 2.5 * k};
        for (int j = 0; j < kBodySide; ++j)
            for (int i = 0; i < kBodySide; ++i)
                slice.pixels.push_back(static_cast<std::uint16_t>(std::lround(bodyAt(i, j, k)) + 1024));
        writeSlice(folder + "/" + std::to_string(100 + k) + ".dcm", slice);
    }
}

void writeTube(const std::string& file) {
    const auto value = [](int i, int j, int k) {
        return std::hypot(2.0 * i - 23, 2.0 * j - 23 + 2 * std::sin(0.5 * k)) < 7 && k > 1 && k < 30 ? 1 : 0;
    };
    writeNrrd(file,
              "type: uchar\ndimension: 3\nsizes: 24 24 32\nspace: left-posterior-superior\n"
              "space directions: (2,0,0) (0,2,0) (0,0,2)\nspace origin: (-24,-24,-24)\nencoding: raw\n",
              grid({24, 24, 32}, value, true));
}

void writePhoto(const std::string& file, int width, int height) {
    Plane<PackedColor> picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(width);
            const float v = static_cast<float>(y) / static_cast<float>(height);
            picture.at(x, y) = packColor(
                {0.2f + 0.5f * u, 0.25f + 0.3f * std::sin(9 * v) * std::sin(7 * u), 0.7f - 0.5f * v});
        }
    writeColorImage(file, picture);
}

// Flat RGBE: a bright patch in a dim sky.
void writeProbe(const std::string& file) {
    constexpr int kWidth = 32, kHeight = 16;
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n";
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool sun = std::abs(x - 10) < 2 && std::abs(y - 4) < 2;
            const unsigned char pixel[]{static_cast<unsigned char>(100 + 4 * y), 140,
                                        static_cast<unsigned char>(200 - 5 * y),
                                        static_cast<unsigned char>(sun ? 133 : 128)};
            bytes.append(reinterpret_cast<const char*>(pixel), 4);
        }
    writeBytes(file, bytes);
}

}  // namespace stereonav::test
