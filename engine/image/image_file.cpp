// Picture files, handed on to their module; Radiance files need no library.
#include "engine/base/module.h"
#include "engine/image/picture_module.h"
#include "engine/image/radiance_file.h"

namespace stereonav {
namespace {

const PictureFunctions& pictures() {
    static const auto& functions =
        moduleFunctions<PictureFunctions>("pictures", "to read and write pictures");
    return functions;
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
    return pictures().encodeColorImage(image, extension);
}

LinearImage readLinearImage(const std::filesystem::path& file) {
    return file.extension() == ".hdr" ? readRadianceImage(file) : pictures().readLinearImage(file);
}

void writeColorImage(const std::filesystem::path& file, const Plane<PackedColor>& image) {
    pictures().writeColorImage(file, image);
}

bool canWritePicture(const std::string& extension) {
    return pictures().canWritePicture(extension);
}

}  // namespace stereonav
