#include "app/output/stereo_picture.h"

#include <fmt/format.h>

#include "app/options/output_place.h"
#include "engine/base/file.h"
#include "engine/image/image_file.h"
#include "engine/image/stereo_picture_file.h"

namespace stereonav {
namespace {

std::string sizeText(const Plane<PackedColor>& picture) {
    return fmt::format("{}x{}", picture.width(), picture.height());
}

void writeBytes(const std::filesystem::path& file, const std::vector<unsigned char>& bytes) {
    writeTextFile(file, {bytes.begin(), bytes.end()});
}

}  // namespace

void checkStereoPicture(const std::string& option, const std::filesystem::path& file) {
    if (isJps(file) || isMpo(file))
        checkOutputFile(option, file);
    else
        checkOutputPicture(option, file);
}

PixelBytes pictureBytes(const std::filesystem::path& file) {
    // Bytes beyond those of other encoders: WebP 50 for cast scenes, 28 for media; floats and JPEG 2000 less.
    constexpr PixelBytes kWholeEncoders{48, 28};
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    PixelBytes bytes = kRenderBytes;
    for (const char* whole : {".webp", ".jp2", ".hdr", ".pic", ".pfm", ".exr"})
        if (extension == whole) bytes.cast += kWholeEncoders.cast, bytes.swept += kWholeEncoders.swept;
    return bytes;
}

std::string writeStereoPicture(const std::filesystem::path& file, const StereoFrame& frame, OutputMode mode) {
    if (isMpo(file)) {
        // the eyes' axes are parallel: off-axis projection
        writeBytes(file, mpoBytes(frame.left().color, frame.right().color, {frame.stereo().separation, 0}));
        return "2 of " + sizeText(frame.left().color);
    }
    const Plane<PackedColor> picture = frame.compose(isJps(file) ? OutputMode::CrossEyed : mode);
    if (isJps(file))
        writeBytes(file, jpsBytes(picture));
    else
        writeColorImage(file, picture);
    return sizeText(picture);
}

}  // namespace stereonav
