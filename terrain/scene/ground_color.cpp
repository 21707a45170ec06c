// Tint, light, and images laid over the ground.
#include "terrain/scene/ground_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "terrain/light/sun_and_sky.h"
#include "terrain/read/raster_file.h"
#include "terrain/scene/ground_texture.h"
#include "terrain/scene/ground_tint.h"

namespace stereonav {
namespace {

constexpr double kPictureBytes = 4 + 1 + 4 * 2;    // a pixel of a picture, and its bands while it is read
constexpr double kTextureBytes = 4 + 4 * 4.0 / 3;  // a texel: the picture, and with its mip levels
constexpr const char* kAdvice = "give a JPEG, PNG or TIFF picture of the ground";

// The height at a grid position; beside a hole that of the known samples around, NaN inside one.
double knownHeightAt(const Heightfield& ground, const glm::dvec2& grid) {
    const double height = ground.heightAt(ground.worldFromGrid(grid));
    if (std::isfinite(height)) return height;
    const int i = std::clamp(static_cast<int>(grid.x), 0, ground.width() - 2);
    const int j = std::clamp(static_cast<int>(grid.y), 0, ground.height() - 2);
    double sum = 0;
    int known = 0;
    for (int k = 0; k < 4; ++k)
        if (const float h = ground.sample(i + k % 2, j + k / 2); std::isfinite(h)) {
            sum += h;
            ++known;
        }
    return known ? sum / known : std::numeric_limits<double>::quiet_NaN();
}

// The ground's tint under the sun.
class Tint {
public:
    Tint(const Heightfield& ground, const TerrainLook& look, const TintPlace& place)
        : Tint(ground, ground, look, place) {}
    Tint(const Heightfield& part, const Heightfield& whole, const TerrainLook& look, const TintPlace& place)
        : mGround(part), mLight(look), mTint(part, place, whole) {}

    // Linear colour of the ground at a grid position, lit.
    glm::vec3 at(const glm::dvec2& grid) const {
        const GroundTint::Site site = mTint.siteAt(grid);
        return mLight.at(site.normal()) * mTint.at(grid, knownHeightAt(mGround, grid), site);
    }

private:
    const Heightfield& mGround;
    GroundLight mLight;
    GroundTint mTint;
};

// Where the image lies: by its own georeference, or over the elevation file's extent.
struct ImagePlace {
    Georeference place;
    bool own = false;
};

ImagePlace placeOf(RasterPicture& picture, const DemGrid& dem) {
    ImagePlace image;
    bool known = false;
    image.place = picture.georeference(known);
    image.own = known && dem.georeferenced;
    if (image.place.wkt.empty()) image.place.wkt = dem.source.wkt;
    if (image.own) return image;
    const double columns = dem.source.width / double(image.place.width);
    const double rows = dem.source.height / double(image.place.height);
    const auto& t = dem.source.transform;
    image.place.wkt = dem.source.wkt;
    image.place.transform = {t[0], t[1] * columns, t[2] * rows, t[3], t[4] * columns, t[5] * rows};
    image.place.points = dem.source.points;
    for (ControlPoint& point : image.place.points) point.pixel /= glm::dvec2(columns, rows);
    return image;
}

// Image pixels for each of the texture's, at its middle.
glm::dvec2 pixelsPerTexel(const PixelMap& map, const Georeference& texture) {
    const int i = texture.width / 2, j = texture.height / 2;
    const int a = std::max(0, i - 1), b = std::max(0, j - 1);
    glm::dvec2 density(1.0);
    if (i > a) density.x = glm::length(map.at(i, j) - map.at(a, j)) / (i - a);
    if (j > b) density.y = glm::length(map.at(i, j) - map.at(i, b)) / (j - b);
    return density;
}

// 0, step, 2 * step, ... and the last.
std::vector<int> spread(int count, int step) {
    std::vector<int> places;
    for (int k = 0; k < count - 1; k += step) places.push_back(k);
    places.push_back(count - 1);
    return places;
}

// The pixels that the texture may touch, with some around.
PixelWindow touchedWindow(const PixelMap& map, const Georeference& texture, const Georeference& image) {
    glm::dvec2 low(1e18), high(-1e18);
    for (const int j : spread(texture.height, PixelMap::kStep))
        for (const int i : spread(texture.width, PixelMap::kStep)) {
            const glm::dvec2 p = map.at(i, j);
            if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    const auto side = [](double v, int most) { return static_cast<int>(std::clamp(v, 0.0, double(most))); };
    return {side(std::floor(low.x) - 2, image.width), side(std::floor(low.y) - 2, image.height),
            side(std::ceil(high.x) + 2, image.width), side(std::ceil(high.y) + 2, image.height)};
}

[[noreturn]] void throwNoOverlap(const std::filesystem::path& file) {
    throw Error(file.string(), "", "the picture does not overlap the elevation model",
                "give one of the same place, or remove its georeference to lay it over the whole");
}

std::string describe(const std::filesystem::path& file, const ImagePlace& image, bool lit) {
    return fmt::format("image {} {}x{}, {}{}", file.filename().string(), image.place.width,
                       image.place.height,
                       !image.own                     ? "over the same extent"
                       : image.place.placedBy.empty() ? "by its georeference"
                                                      : "by its " + image.place.placedBy,
                       lit ? ", lit" : "");
}

}  // namespace

GroundLight::GroundLight(const TerrainLook& look) {
    const double across = std::cos(look.sunElevation), up = std::sin(look.sunElevation);
    const double level = look.ambient + (1 - look.ambient) * std::max(0.0, up);
    if (level <= 0) return;  // a sun below the horizon and no ambient light: night
    mAmbient = look.ambient / level;
    mDirect = sunUp(up) * (1 - look.ambient) / level *
              glm::dvec3(across * std::sin(look.sunAzimuth), across * std::cos(look.sunAzimuth), up);
}

float GroundLight::at(const glm::dvec3& unitNormal) const {
    return static_cast<float>(mAmbient + std::max(0.0, glm::dot(unitNormal, mDirect)));
}

double bytesOfTint(double samples) {
    return kTextureBytes * std::min(kMostGroundTexels, kLitDensity * kLitDensity * samples) +
           GroundTint::kBytesPerSample * samples;
}

GroundColor tintedGround(const Heightfield& ground, const TerrainLook& look, const TintPlace& place,
                         Progress& progress) {
    const Tint tint(ground, look, place);
    const GroundTextureSize size = groundTextureSize(ground, glm::dvec2(kLitDensity));
    const auto color = [&](int, int, const glm::dvec2& grid) { return tint.at(grid); };
    return {groundTexture(ground, size, color, progress), "tint by height and slope, lit", look.ambient < 1};
}

ColorTexture tintedPart(const Heightfield& part, const Heightfield& whole, const TerrainLook& look,
                        const TintPlace& place, double density, Progress& progress) {
    const Tint tint(part, whole, look, place);
    const auto color = [&](int, int, const glm::dvec2& grid) { return tint.at(grid); };
    return groundTexture(part, groundTextureSize(part, glm::dvec2(density)), color, progress);
}

GroundColor groundFromImage(const std::filesystem::path& file, const DemGrid& dem, const Heightfield& ground,
                            const TerrainLook& look, const TintPlace& tinted, Progress& progress) {
    const auto opened = openRasterPicture(file, "a picture", kAdvice);
    const ImagePlace image = placeOf(*opened, dem);
    if (!overlap(dem.grid, image.place, file)) throwNoOverlap(file);
    const glm::dvec2 density = pixelsPerTexel(mapPixels(dem.grid, image.place, file), dem.grid);
    if (!std::isfinite(density.x + density.y)) throwNoOverlap(file);
    const GroundTextureSize size =
        groundTextureSize(ground, look.shadeImage ? glm::max(density, glm::dvec2(kLitDensity)) : density);
    Georeference texture = dem.grid;
    texture.width = size.width;
    texture.height = size.height;
    const auto& t = dem.grid.transform;
    texture.transform = {t[0], t[1] * dem.grid.width / size.width,  0, t[3],
                         0,    t[5] * dem.grid.height / size.height};
    const PixelMap map = mapPixels(texture, image.place, file);
    const PixelWindow window = touchedWindow(map, texture, image.place);
    if (window.xMin >= window.xMax || window.yMin >= window.yMax) throwNoOverlap(file);
    progress.report(0, "reading " + file.filename().string());
    const glm::dvec2 shrink = glm::max(glm::dvec2(1.0), pixelsPerTexel(map, texture));
    const auto pixels = [](int low, int high, double by) { return std::max(1.0, (high - low) / by); };
    checkMemory(file.string(),
                kTextureBytes * size.width * size.height + kPictureBytes *
                                                               pixels(window.xMin, window.xMax, shrink.x) *
                                                               pixels(window.yMin, window.yMax, shrink.y),
                "give a smaller picture of the ground");
    const GroundPicture picture = opened->read(window, shrink);
    const Tint tint(ground, look, tinted);
    const GroundLight light(look);
    std::atomic<bool> lit{look.shadeImage};
    const auto color = [&](int column, int row, const glm::dvec2& grid) {
        const GroundPicture::Sample sample = picture.at(map.at(column, row));
        glm::vec3 seen = sample.color;
        if (look.shadeImage && sample.cover > 0)
            seen *= light.at(ground.normalAt(ground.worldFromGrid(grid)));
        if (sample.cover >= 1) return seen;
        lit = true;
        return glm::mix(tint.at(grid), seen, sample.cover);
    };
    ColorTexture laid = groundTexture(ground, size, color, progress);
    return {std::move(laid), describe(file, image, look.shadeImage), lit && look.ambient < 1};
}

}  // namespace stereonav
