// Sky pictures, equirectangular, resampled into the octahedral map.
#include "terrain/light/sky_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <vector>

#include "engine/base/error.h"
#include "engine/image/image_file.h"
#include "engine/math/luminance.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr int kGradientSize = 1024;  // a texel is 0.2 degrees
constexpr int kSmallestMap = 1024, kLargestMap = 2048;

bool coversSphere(int width, int height) {
    return std::abs(width - 2.0 * height) <= 0.02 * width;
}

// Box average of 2 x 2; the last column or row of an odd size is averaged alone.
LinearImage halved(const LinearImage& fine) {
    LinearImage coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    const auto at = [&](int x, int y) {
        const std::size_t row = static_cast<std::size_t>(std::min(y, fine.height - 1)) * fine.width;
        return fine.pixels[row + std::min(x, fine.width - 1)];
    };
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x)
            coarse.pixels.push_back(0.25f * (at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) +
                                             at(2 * x + 1, 2 * y + 1)));
    return coarse;
}

void toneMap(LinearImage& probe, bool sphere) {
    constexpr float kKey = 0.18f, kTiny = 1e-6f;
    double sum = 0, weights = 0;
    std::vector<float> scaled;
    scaled.reserve(probe.pixels.size());
    for (int y = 0; y < probe.height; ++y) {
        const double share = (y + 0.5) / probe.height;
        const double weight = std::sin(share * std::numbers::pi * (sphere ? 1.0 : 0.5));  // solid angle
        for (int x = 0; x < probe.width; ++x) {
            const float l = luminance(probe.pixels[static_cast<std::size_t>(y) * probe.width + x]);
            scaled.push_back(std::isfinite(l) ? std::max(0.0f, l) : 0.0f);
            sum += weight * std::log(kTiny + scaled.back());
            weights += weight;
        }
    }
    const float exposure = kKey / static_cast<float>(std::exp(sum / weights));
    const auto percentile = scaled.begin() + static_cast<std::ptrdiff_t>(0.995 * double(scaled.size() - 1));
    std::nth_element(scaled.begin(), percentile, scaled.end());
    const float white = std::max(1.0f, *percentile * exposure);
    for (glm::vec3& c : probe.pixels) {
        const float l = std::max(0.0f, luminance(c)) * exposure;
        const float factor = exposure * (1 + l / (white * white)) / (1 + l);
        c = std::isfinite(factor) ? c * factor : glm::vec3(0.0f);
    }
}

// Returns a bilinear mean; around the horizon the columns close, at top and bottom the rows end.
glm::vec3 lookUp(const LinearImage& image, double u, double v) {
    const double x = u * image.width - 0.5, y = std::clamp(v * image.height - 0.5, 0.0, image.height - 1.0);
    const double left = std::floor(x);
    const int i = (static_cast<int>(left) % image.width + image.width) % image.width;
    const int i1 = (i + 1) % image.width, j = static_cast<int>(y), j1 = std::min(j + 1, image.height - 1);
    const float a = static_cast<float>(x - left), b = static_cast<float>(y - j);
    const glm::vec3* top = &image.pixels[static_cast<std::size_t>(j) * image.width];
    const glm::vec3* bottom = &image.pixels[static_cast<std::size_t>(j1) * image.width];
    return glm::mix(glm::mix(top[i], top[i1], a), glm::mix(bottom[i], bottom[i1], a), b);
}

glm::vec3 skyColorOf(const LinearImage& image, bool sphere, const glm::vec3& d) {
    const double heading = std::atan2(double(d.x), double(d.y));
    const double fromZenith = std::acos(std::clamp(double(d.z), -1.0, 1.0));
    const double v = fromZenith / std::numbers::pi * (sphere ? 1.0 : 2.0);
    return lookUp(image, 0.5 + heading / (2 * std::numbers::pi), v);
}

// Texels a side, as many as the source has columns: twice what its horizon needs, for lookups of the nearest
// texel.
int mapSize(int columns) {
    return std::clamp(columns, kSmallestMap, kLargestMap);
}

struct SkyPicture {
    LinearImage image;
    std::string source;
    bool sphere;
};

SkyPicture described(LinearImage image, const std::filesystem::path& file, const char* kind, int width,
                     int height) {
    const bool sphere = coversSphere(width, height);
    return {std::move(image),
            fmt::format("{} {} {}x{}, {}", kind, file.filename().string(), width, height,
                        sphere ? "the whole sphere" : "a panorama above the horizon"),
            sphere};
}

SkyPicture readProbe(const std::filesystem::path& file) {
    LinearImage image = readLinearImage(file);
    const int width = image.width, height = image.height;
    toneMap(image, coversSphere(width, height));
    while (image.width > 2 * mapSize(width)) image = halved(image);
    return described(std::move(image), file, "light probe", width, height);
}

SkyPicture readPicture(const std::filesystem::path& file) {
    constexpr const char* kAdvice = "give a JPEG, PNG, TIFF or Radiance .hdr picture";
    const auto opened = openRasterPicture(file, "a picture of the sky", kAdvice);
    bool placed = false;
    const Georeference whole = opened->georeference(placed);
    const int width = whole.width, height = whole.height;
    const double shrink = std::max(1.0, width / (2.0 * mapSize(width)));
    const GroundPicture picture =
        opened->read({0, 0, width, height}, glm::dvec2(shrink), opened->wholeTone());
    LinearImage image{std::max(1, static_cast<int>(width / shrink + 0.5)),
                      std::max(1, static_cast<int>(height / shrink + 0.5)),
                      {}};
    image.pixels.reserve(static_cast<std::size_t>(image.width) * image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.pixels.push_back(
                picture.at({(x + 0.5) * width / image.width, (y + 0.5) * height / image.height}).color);
    return described(std::move(image), file, "picture", width, height);
}

}  // namespace

SkySource readSky(const std::filesystem::path& file) {
    if (file.empty()) return {SkyMap(kGradientSize, gradientSky), "built-in gradient"};
    const SkyPicture sky = file.extension() == ".hdr" ? readProbe(file) : readPicture(file);
    return {SkyMap(mapSize(sky.image.width),
                   [&](const glm::vec3& d) { return skyColorOf(sky.image, sky.sphere, d); }),
            sky.source};
}

}  // namespace stereonav
