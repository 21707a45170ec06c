#include "terrain/scene/laid_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "terrain/read/raster_file.h"

namespace stereonav {
namespace {

constexpr double kPictureBytes = 4 + 1 + 4 * 2;        // a pixel of a picture, and its bands while it is read
constexpr double kLaidTextureBytes = 4 + 4 * 4.0 / 3;  // a texel: the picture, and with its mip levels

std::unique_ptr<RasterPicture> openPicture(const std::filesystem::path& file) {
    return openRasterPicture(file, "a picture", "give a JPEG, PNG or TIFF picture of the ground");
}

// Lays the picture over the elevation file's extent, whatever its aspect.
void layOverAll(const DemGrid& dem, Georeference& place) {
    const double columns = dem.source.width / double(place.width);
    const double rows = dem.source.height / double(place.height);
    const auto& t = dem.source.transform;
    place.wkt = dem.source.wkt;
    place.transform = {t[0], t[1] * columns, t[2] * rows, t[3], t[4] * columns, t[5] * rows};
    place.points = dem.source.points;
    for (ControlPoint& point : place.points) point.pixel /= glm::dvec2(columns, rows);
}

// Image pixels for each of the texture's, at its middle.
glm::dvec2 pixelsPerTexel(const PixelMap& map, int width, int height) {
    const int i = width / 2, j = height / 2;
    const int a = std::max(0, i - 1), b = std::max(0, j - 1);
    glm::dvec2 density(1.0);
    if (i > a) density.x = glm::length(map.at(i, j) - map.at(a, j)) / (i - a);
    if (j > b) density.y = glm::length(map.at(i, j) - map.at(i, b)) / (j - b);
    return density;
}

// The finest samples around the model's middle: all of a large one would be a map of gigabytes.
Georeference middleOf(const Georeference& grid) {
    constexpr int kSide = 4;
    Georeference middle = grid;
    const int i = std::max(0, grid.width / 2 - kSide / 2), j = std::max(0, grid.height / 2 - kSide / 2);
    middle.width = std::min(kSide, grid.width);
    middle.height = std::min(kSide, grid.height);
    const glm::dvec2 corner = grid.fromPixel({i, j});
    middle.transform[0] = corner.x;
    middle.transform[3] = corner.y;
    return middle;
}

// 0, step, 2 * step, ... and the last.
std::vector<int> spread(int count, int step) {
    std::vector<int> places;
    for (int k = 0; k < count - 1; k += step) places.push_back(k);
    places.push_back(count - 1);
    return places;
}

// The pixels that the texture may touch, with some around.
PixelWindow touchedWindow(const PixelMap& map, const GroundTextureSize& texture, const Georeference& image) {
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

}  // namespace

LaidPicture::LaidPicture(const std::filesystem::path& file, const DemGrid& dem)
    : mFile(file), mGrid(dem.grid), mSpacing(dem.spacing) {
    bool known = false;
    const auto picture = openPicture(file);
    mPlace = picture->georeference(known);
    mOwn = known && dem.georeferenced;
    if (mPlace.wkt.empty()) mPlace.wkt = dem.source.wkt;
    if (!mOwn) layOverAll(dem, mPlace);
    if (!overlap(mGrid, mPlace, file)) throwNoOverlap();
    const Georeference middle = middleOf(mGrid);
    mDensity = pixelsPerTexel(mapPixels(middle, mPlace, file), middle.width, middle.height);
    if (!std::isfinite(mDensity.x + mDensity.y)) throwNoOverlap();
    mTone = picture->tone();
}

// Returns the texture's grid by the places of the ground's samples in the world, whose origin is the middle
// of the model's grid.
Georeference LaidPicture::gridOf(const Heightfield& ground, const GroundTextureSize& size) const {
    const glm::dvec2 first = -0.5 * glm::dvec2(mGrid.width - 1, mGrid.height - 1) * mSpacing;
    const glm::dvec2 samples = ground.spacing() / mSpacing, at = (ground.originWorld() - first) / mSpacing;
    const double west = at.x + 0.5 - 0.5 * samples.x,
                 north = mGrid.height - 0.5 - at.y - (ground.height() - 0.5) * samples.y;
    const auto& t = mGrid.transform;
    Georeference texture = mGrid;
    texture.width = size.width;
    texture.height = size.height;
    texture.transform = {t[0] + west * t[1],
                         t[1] * (ground.width() * samples.x) / size.width,
                         0,
                         t[3] + north * t[5],
                         0,
                         t[5] * (ground.height() * samples.y) / size.height};
    return texture;
}

std::optional<LaidPicture::Pixels> LaidPicture::over(const Heightfield& ground,
                                                     const GroundTextureSize& size) const {
    PixelMap map = mapPixels(gridOf(ground, size), mPlace, mFile);
    const PixelWindow window = touchedWindow(map, size, mPlace);
    if (window.xMin >= window.xMax || window.yMin >= window.yMax) return std::nullopt;
    const glm::dvec2 shrink = glm::max(glm::dvec2(1.0), pixelsPerTexel(map, size.width, size.height));
    const auto pixels = [](int low, int high, double by) { return std::max(1.0, (high - low) / by); };
    checkMemory(mFile.string(),
                kLaidTextureBytes * size.width * size.height +
                    kPictureBytes * pixels(window.xMin, window.xMax, shrink.x) *
                        pixels(window.yMin, window.yMax, shrink.y),
                "give a smaller picture of the ground");
    const auto opened = openPicture(mFile);
    bool known = false;
    const Georeference now = opened->georeference(known);
    if (now.width != mPlace.width || now.height != mPlace.height)
        throw Error(mFile.string(), "",
                    fmt::format("expected the picture of {}x{} pixels that was there before, found {}x{}",
                                mPlace.width, mPlace.height, now.width, now.height),
                    "open the scene again");
    return Pixels{std::move(map), opened->read(window, shrink, mTone)};
}

std::string LaidPicture::describe() const {
    return fmt::format("image {} {}x{}, {}", mFile.filename().string(), mPlace.width, mPlace.height,
                       !mOwn                     ? "over the same extent"
                       : mPlace.placedBy.empty() ? "by its georeference"
                                                 : "by its " + mPlace.placedBy);
}

void LaidPicture::throwNoOverlap() const {
    throw Error(mFile.string(), "", "the picture does not overlap the elevation model",
                "give one of the same place, or remove its georeference to lay it over the whole");
}

}  // namespace stereonav
