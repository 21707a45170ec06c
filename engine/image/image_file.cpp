// Picture files, handed on to their module; writing PNG and reading Radiance files need none.
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/module.h"
#include "engine/image/picture_module.h"
#include "engine/image/png_writer.h"
#include "engine/image/radiance_file.h"

namespace stereonav {
namespace {

const PictureFunctions& pictures() {
    static const auto& functions =
        moduleFunctions<PictureFunctions>("pictures", "to read and write pictures");
    return functions;
}

bool isPng(const std::string& extension) {
    return extension == ".png" || extension == ".PNG";
}

}  // namespace

Plane<PackedColor> readColorImage(const std::filesystem::path& file) {
    return pictures().readColorImage(file);
}

Plane<PackedColor> decodeColorImage(std::span<const unsigned char> bytes, const std::string& file,
                                    const std::string& place) {
    return pictures().decodeColorImage(bytes, file, place);
}

std::vector<unsigned char> encodeColorImage(const Plane<PackedColor>& image, const std::string& extension) {
    return isPng(extension) ? pngBytes(image) : pictures().encodeColorImage(image, extension);
}

LinearImage readLinearImage(const std::filesystem::path& file) {
    return file.extension() == ".hdr" ? readRadianceImage(file) : pictures().readLinearImage(file);
}

void writeColorImage(const std::filesystem::path& file, const Plane<PackedColor>& image, Flush flush) {
    const std::string extension = isStandardOutput(file) ? ".png" : file.extension().string();
    if (extension.empty() || !canWritePicture(extension))
        throw Error(file.string(), "", "can not be written as a picture", "use .png or .jpg");
    const std::vector<unsigned char> bytes = encodeColorImage(image, extension);
    writeTextFile(file, {bytes.begin(), bytes.end()}, flush);
}

bool canWritePicture(const std::string& extension) {
    return isPng(extension) || pictures().canWritePicture(extension);
}

}  // namespace stereonav
