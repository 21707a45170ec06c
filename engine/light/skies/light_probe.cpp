// A light probe's pixels: checked, looked up by direction, chosen by brightness. A pixel is a piece of the
// sphere between two parallels and two meridians, so its solid angle and the directions in it are exact.
#include "engine/light/skies/light_probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/base/error.h"
#include "engine/image/image_file.h"
#include "engine/math/constants.h"
#include "engine/math/luminance.h"

namespace stereonav {
namespace {

void checkSize(int width, int height, std::size_t pixels, const std::string& name) {
    if (width > 0 && height > 0 && pixels == static_cast<std::size_t>(width) * height) return;
    throw Error(name, "",
                "expected a light probe of at least one pixel, got " + std::to_string(width) + " x " +
                    std::to_string(height) + " with " + std::to_string(pixels) + " pixels",
                "give an equirectangular picture");
}

void checkPixels(int width, const std::vector<glm::vec3>& pixels, const std::string& name) {
    const auto bad = std::find_if(pixels.begin(), pixels.end(), [](const glm::vec3& p) {
        // NaN fails every comparison
        return !(p.x >= 0 && p.y >= 0 && p.z >= 0 && std::isfinite(p.x) && std::isfinite(p.y) &&
                 std::isfinite(p.z));
    });
    if (bad == pixels.end()) return;
    const auto at = bad - pixels.begin();
    throw Error(name, "pixel " + std::to_string(at % width) + ", " + std::to_string(at / width),
                "expected radiance of 0 or more, got " + std::to_string(bad->x) + " " +
                    std::to_string(bad->y) + " " + std::to_string(bad->z),
                "repair the picture");
}

// Index of x in 0..1 among n equal parts; NaN counts as 0.
int part(double x, int n) {
    const double scaled = x * n;
    return scaled > 0 ? std::min(static_cast<int>(std::min(scaled, 1e9)), n - 1) : 0;
}

// Turns the values behind the first entry, which is 0, into running sums that end at exactly 1; returns their
// sum. Where all values are 0 the running sums rise evenly.
double accumulate(double* begin, double* end) {
    for (double* p = begin + 1; p != end; ++p) *p += p[-1];
    const double total = end[-1];
    const auto count = static_cast<double>(end - begin - 1);
    for (double* p = begin + 1; p != end; ++p)
        *p = total > 0 ? *p / total : static_cast<double>(p - begin) / count;
    return total;
}

struct Choice {
    int index;
    double fraction;  // 0..1 within the entry, so that one random number u serves twice
};

// Chooses the entry that u falls into; entries of width 0 are never chosen.
Choice choose(const double* begin, const double* end, double u) {
    const double inside = u > 0 ? std::min(u, 1.0 - 0x1p-53) : 0.0;  // NaN: 0
    const double* above = std::upper_bound(begin, end, inside);
    const double width = above[0] - above[-1];
    return {static_cast<int>(above - begin) - 1, (inside - above[-1]) / width};
}

}  // namespace

LightProbe::LightProbe(int width, int height, std::vector<glm::vec3> radiance, const std::string& name)
    : mWidth(width), mHeight(height), mRadiance(std::move(radiance)) {
    checkSize(width, height, mRadiance.size(), name);
    checkPixels(width, mRadiance, name);
    mEdges.resize(static_cast<std::size_t>(height) + 1);
    for (int j = 0; j <= height; ++j) mEdges[j] = std::cos(kPi * j / height);
    mRows.assign(mEdges.size(), 0.0);
    mColumns.assign((static_cast<std::size_t>(width) + 1) * height, 0.0);
    glm::dvec3 sum(0.0);
    for (int j = 0; j < height; ++j) {
        fillRow(j);
        glm::dvec3 row(0.0);
        for (int i = 0; i < width; ++i) row += glm::dvec3(mRadiance[index({i, j})]);
        sum += row * (mEdges[j] - mEdges[j + 1]);
    }
    mMean = glm::vec3(sum / (2.0 * width));
    mBlack = accumulate(mRows.data(), mRows.data() + mRows.size()) <= 0;
}

void LightProbe::fillRow(int row) {
    double* columns = &mColumns[(static_cast<std::size_t>(mWidth) + 1) * row];
    for (int i = 0; i < mWidth; ++i) columns[i + 1] = luminance(glm::dvec3(mRadiance[index({i, row})]));
    mRows[row + 1] = accumulate(columns, columns + mWidth + 1) * (mEdges[row] - mEdges[row + 1]);
}

LightProbe::Pixel LightProbe::pixelOf(const glm::vec3& direction) const {
    const double x = direction.x, y = direction.y, z = direction.z;
    // The arc tangent keeps its precision at the poles, where the arc cosine loses it.
    const double polar = std::atan2(std::sqrt(x * x + y * y), z);
    const double azimuth = std::atan2(y, x);
    return {part(azimuth / (2 * kPi) + 0.5, mWidth), part(polar / kPi, mHeight)};
}

glm::vec3 LightProbe::radiance(const glm::vec3& direction) const {
    return mRadiance[index(pixelOf(direction))];
}

double LightProbe::densityOf(const Pixel& p) const {
    if (mBlack) return 0;
    const double* columns = &mColumns[(static_cast<std::size_t>(mWidth) + 1) * p.row + p.column];
    const double chance = (mRows[p.row + 1] - mRows[p.row]) * (columns[1] - columns[0]);
    return chance * mWidth / (2 * kPi * (mEdges[p.row] - mEdges[p.row + 1]));
}

LightProbe::Seen LightProbe::seen(const glm::vec3& direction) const {
    const Pixel pixel = pixelOf(direction);
    return {mRadiance[index(pixel)], static_cast<float>(densityOf(pixel))};
}

float LightProbe::density(const glm::vec3& direction) const {
    return static_cast<float>(densityOf(pixelOf(direction)));
}

// Returns a direction, uniform over the pixel's piece of the sphere for uniform fractions.
glm::vec3 LightProbe::directionIn(const Pixel& pixel, const glm::dvec2& fraction) const {
    const double z = mEdges[pixel.row] + (mEdges[pixel.row + 1] - mEdges[pixel.row]) * fraction.y;
    const double radius = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    const double azimuth = 2 * kPi * ((pixel.column + fraction.x) / mWidth - 0.5);
    return glm::vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
}

LightProbe::Sample LightProbe::sample(const glm::vec2& u) const {
    if (mBlack) return {{0, 0, 1}, {0, 0, 0}, 0};
    const Choice row = choose(mRows.data(), mRows.data() + mRows.size(), u.y);
    const double* columns = &mColumns[(static_cast<std::size_t>(mWidth) + 1) * row.index];
    const Choice column = choose(columns, columns + mWidth + 1, u.x);
    const Pixel pixel{column.index, row.index};
    glm::dvec2 fraction(column.fraction, row.fraction);
    glm::vec3 direction = directionIn(pixel, fraction);
    // A direction rounded to floats may land in a neighbouring pixel, whose density differs: it is moved
    // towards the pixel's middle.
    for (const double pull : {0.999, 0.9, 0.0}) {
        const Pixel met = pixelOf(direction);
        if (met.row == pixel.row && met.column == pixel.column) break;
        direction = directionIn(pixel, 0.5 + (fraction - 0.5) * pull);
    }
    return {direction, mRadiance[index(pixel)], static_cast<float>(densityOf(pixel))};
}

// A panorama runs clockwise as seen from above, columns of a probe the other way; the picture's middle is a
// quarter turn from azimuth 0.
LightProbe readLightProbe(const std::filesystem::path& file) {
    const LinearImage image = readLinearImage(file);
    const int w = image.width, quarter = (w + 2) / 4;
    std::vector<glm::vec3> pixels(image.pixels.size());
    for (std::size_t row = 0; row < pixels.size(); row += static_cast<std::size_t>(std::max(w, 1)))
        for (int column = 0; column < w; ++column)
            pixels[row + static_cast<std::size_t>(column)] =
                image.pixels[row + static_cast<std::size_t>((w + quarter - 1 - column) % w)];
    return LightProbe(w, image.height, std::move(pixels), file.string());
}

}  // namespace stereonav
