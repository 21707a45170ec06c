// Recognizes picture formats by a file's first bytes. Files in other formats are refused before any library
// sees them, and a picture is only ever given to the decoder of its own format.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace stereonav {

enum class PictureFormat : std::int32_t { Png, Jpeg, Tiff, Bmp, WebP, Radiance };

// Returns the format; empty for all others. content: the file's bytes.
std::optional<PictureFormat> pictureFormatOf(std::string_view content);

// Advice for messages.
inline constexpr const char* kGiveAPicture = "give a PNG, JPEG, TIFF, BMP, WebP or Radiance .hdr file";

// Sides and pixels of the largest pictures that are read.
inline constexpr int kMostPictureSide = 65536;
inline constexpr long long kMostPicturePixels = 1ll << 28;
bool isPictureSize(long long width, long long height);

// The header of a picture file, read before anything is unpacked.
struct PictureHead {
    long long width = 0, height = 0;
    int sampleBytes = 1;  // bytes of a channel: 1, 2, or 4 of floats
};
// Returns the head of the first picture in the file; nothing where it is cut off or makes no sense. Sizes are
// as the file has them, however large. Takes all formats but Radiance, whose reader is our own.
std::optional<PictureHead> pictureHeadOf(PictureFormat format, std::string_view content);

}  // namespace stereonav
