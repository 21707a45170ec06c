// Picture files: what they are is told by their first bytes (picture_format.h), reading them is for a helper
// (decoded_picture.h), writing others than PNG for a module. Radiance files are read here.
#include "engine/image/image_file.h"

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/image/decoded_picture.h"
#include "engine/image/picture_module.h"
#include "engine/image/png_writer.h"
#include "engine/image/radiance_file.h"

namespace stereonav {
namespace {

const PictureFunctions& pictures() {
    static const auto& functions = moduleFunctions<PictureFunctions>("pictures", "to write pictures");
    return functions;
}

bool isPng(const std::string& extension) {
    return extension == ".png" || extension == ".PNG";
}

std::string contentOf(const std::filesystem::path& file) {
    std::string content = readTextFile(file);
    if (content.empty()) throw Error(file.string(), "", "the file is empty", "name an image file");
    return content;
}

PictureFormat formatOf(std::string_view content, const std::string& file, const std::string& place) {
    if (content.empty()) throw Error(file, place, "the picture is empty", "name an image file");
    const std::optional<PictureFormat> format = pictureFormatOf(content);
    if (!format)
        throw Error(file, place, "is not a picture of a format that is read here, by its first bytes",
                    kGiveAPicture);
    return *format;
}

float linear(std::uint8_t sample) {
    return linearFromSrgb(static_cast<float>(sample) / 255.0f);
}
float linear(std::uint16_t sample) {
    return linearFromSrgb(static_cast<float>(sample) / 65535.0f);
}
float linear(float sample) {
    return sample;
}

template <typename Sample>
glm::vec3 linearPixel(const Sample* bgr) {
    return {linear(bgr[2]), linear(bgr[1]), linear(bgr[0])};
}
template <typename Sample>
PackedColor packedPixel(const Sample* bgr) {
    return packColor(linearPixel(bgr));
}
PackedColor packedPixel(const std::uint8_t* bgr) {
    const auto& table = packedFromSrgbByte();
    return static_cast<PackedColor>(table[bgr[2]] | table[bgr[1]] << 10 | table[bgr[0]] << 20);
}

template <typename Sample>
Plane<PackedColor> packed(const DecodedPicture& picture) {
    Plane<PackedColor> plane(picture.width, picture.height);
    const Sample* from = picture.pixels<Sample>();
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x, from += 3) plane.at(x, y) = packedPixel(from);
    return plane;
}

template <typename Sample>
LinearImage linearImage(const DecodedPicture& picture) {
    LinearImage image{picture.width, picture.height, {}};
    const Sample* from = picture.pixels<Sample>();
    image.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    for (glm::vec3& pixel : image.pixels) {
        pixel = linearPixel(from);
        from += 3;
    }
    return image;
}

Plane<PackedColor> packedImage(const LinearImage& image) {
    Plane<PackedColor> plane(image.width, image.height);
    const glm::vec3* from = image.pixels.data();
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) plane.at(x, y) = packColor(*from++);
    return plane;
}

}  // namespace

Plane<PackedColor> readColorImage(const std::filesystem::path& file) {
    const std::string content = contentOf(file);
    return decodeColorImage({reinterpret_cast<const unsigned char*>(content.data()), content.size()},
                            file.string(), "");
}

Plane<PackedColor> decodeColorImage(std::span<const unsigned char> bytes, const std::string& file,
                                    const std::string& place) {
    const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const PictureFormat format = formatOf(content, file, place);
    if (format == PictureFormat::Radiance) return packedImage(radianceImageOf(content, file, place));
    const DecodedPicture picture = decodePicture(format, content, sizeof(PackedColor), file, place);
    if (picture.sampleBytes == 1) return packed<std::uint8_t>(picture);
    return picture.sampleBytes == 2 ? packed<std::uint16_t>(picture) : packed<float>(picture);
}

LinearImage readLinearImage(const std::filesystem::path& file) {
    const std::string content = contentOf(file);
    const PictureFormat format = formatOf(content, file.string(), "");
    if (format == PictureFormat::Radiance) return radianceImageOf(content, file.string(), "");
    const DecodedPicture picture = decodePicture(format, content, sizeof(glm::vec3), file.string(), "");
    if (picture.sampleBytes == 1) return linearImage<std::uint8_t>(picture);
    return picture.sampleBytes == 2 ? linearImage<std::uint16_t>(picture) : linearImage<float>(picture);
}

std::vector<unsigned char> encodeColorImage(const Plane<PackedColor>& image, const std::string& extension) {
    return isPng(extension) ? pngBytes(image) : pictures().encodeColorImage(image, extension);
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
