#include "app/output/stereo_picture.h"

#include <fmt/format.h>

#include "app/output/output_place.h"
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

std::string writeStereoPicture(const std::filesystem::path& file, const StereoFrame& frame, OutputMode mode) {
    if (isMpo(file)) {
        // off-axis eyes: their axes are parallel
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
