// Each row is filtered the way that leaves the smallest sum of differences (ISO/IEC 15948, 12.8), then all is
// deflated.
#include "engine/image/png_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr int kChannels = 3;
constexpr int kLevel = 4;                       // of deflate: 1 fastest .. 9 smallest
constexpr std::size_t kLongestChunk = 1 << 24;  // bytes; the format ends at 2^31
constexpr int kFilters[] = {1, 2, 4};           // Sub, Up, Paeth

void addNumber(Bytes& to, std::size_t value) {
    for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<unsigned char>(value >> shift));
}

void addChunk(Bytes& to, std::string_view type, const Bytes& data) {
    addNumber(to, data.size());
    const std::size_t from = to.size();
    to.insert(to.end(), type.begin(), type.end());
    to.insert(to.end(), data.begin(), data.end());
    addNumber(to, crc32(0, &to[from], static_cast<uInt>(to.size() - from)));
}

int paeth(int left, int above, int corner) {
    const int p = left + above - corner;
    const int a = std::abs(p - left), b = std::abs(p - above), c = std::abs(p - corner);
    if (a <= b && a <= c) return left;
    return b <= c ? above : corner;
}

// What filter predicts at byte n of a row; rows begin with kChannels zeros.
int predicted(int filter, const Bytes& row, const Bytes& above, std::size_t n) {
    if (filter == 1) return row[n - kChannels];
    if (filter == 2) return above[n];
    return paeth(row[n - kChannels], above[n], above[n - kChannels]);
}

// The filter's number and the differences.
Bytes filtered(int filter, const Bytes& row, const Bytes& above) {
    Bytes out{static_cast<unsigned char>(filter)};
    out.reserve(row.size());
    for (std::size_t n = kChannels; n < row.size(); ++n)
        out.push_back(static_cast<unsigned char>(row[n] - predicted(filter, row, above, n)));
    return out;
}

long sumOf(const Bytes& differences) {
    long sum = 0;
    for (std::size_t n = 1; n < differences.size(); ++n)
        sum += std::min<int>(differences[n], 256 - differences[n]);
    return sum;
}

Bytes rowOf(const Plane<PackedColor>& image, int y) {
    const auto& table = srgbByteFromPacked();
    Bytes row(kChannels, 0);
    row.reserve(static_cast<std::size_t>(kChannels) * (image.width() + 1));
    for (int x = 0; x < image.width(); ++x)
        for (const int shift : {0, 10, 20}) row.push_back(table[image.at(x, y) >> shift & 1023]);
    return row;
}

Bytes filteredRows(const Plane<PackedColor>& image) {
    Bytes all, above(static_cast<std::size_t>(kChannels) * (image.width() + 1), 0);
    all.reserve(above.size() * image.height());
    for (int y = 0; y < image.height(); ++y) {
        const Bytes row = rowOf(image, y);
        std::array<Bytes, std::size(kFilters)> tried;
        for (std::size_t k = 0; k < tried.size(); ++k) tried[k] = filtered(kFilters[k], row, above);
        const auto best = std::min_element(
            tried.begin(), tried.end(), [](const Bytes& a, const Bytes& b) { return sumOf(a) < sumOf(b); });
        all.insert(all.end(), best->begin(), best->end());
        above = row;
    }
    return all;
}

Bytes deflated(const Bytes& bytes) {
    uLongf size = compressBound(bytes.size());
    Bytes out(size);
    if (compress2(out.data(), &size, bytes.data(), bytes.size(), kLevel) != Z_OK)
        throw Error("", "picture", "can not be compressed", "free memory");
    out.resize(size);
    return out;
}

}  // namespace

std::vector<unsigned char> pngBytes(const Plane<PackedColor>& image) {
    if (image.empty())
        throw Error("", "picture", "expected at least one pixel, got none", "choose a larger size");
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    Bytes png(kSignature.begin(), kSignature.end()), header;
    addNumber(header, image.width());
    addNumber(header, image.height());
    header.insert(header.end(), {8, 2, 0, 0, 0});  // bits, RGB, deflate, the filters above, not interlaced
    addChunk(png, "IHDR", header);
    addChunk(png, "sRGB", {0});  // perceptual
    const Bytes data = deflated(filteredRows(image));
    for (std::size_t at = 0; at < data.size(); at += kLongestChunk)
        addChunk(png, "IDAT", {data.begin() + at, data.begin() + std::min(at + kLongestChunk, data.size())});
    addChunk(png, "IEND", {});
    return png;
}

}  // namespace stereonav
