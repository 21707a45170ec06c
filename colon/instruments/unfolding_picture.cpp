// Pictures of the unfolded wall: lit, and as a map of its distortion; and how polyps show in it.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "colon/instruments/unfolding.h"
#include "engine/base/parallel.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

constexpr double kSquare = 0.01;  // metres: areas are compared over squares of this side
constexpr int kMark = 10;         // pixels of a long mark of the scale

}  // namespace

Plane<PackedColor> UnfoldedWall::picture(const VolumeLook& look, std::span<const Mark> marks) const {
    const PackedColor white = packColor(glm::vec3(1)), black = packColor(glm::vec3(0));
    const int square = std::max(static_cast<int>(std::lround(kSquare / mSetting.pixel)), 1);
    const int scale = mHeight + kMark;
    Plane<PackedColor> picture(std::max(mWidth, 2 * square), scale + 2 * kMark + square + 2);
    parallelFor(picture.height(), [&](int y) {
        for (int x = 0; x < picture.width(); ++x) {
            picture.at(x, y) = white;
            const std::uint32_t vertex = x < mWidth && y < mHeight ? vertexAt(x, y) : kNone;
            if (vertex == kNone) continue;
            const std::size_t at = static_cast<std::size_t>(y) * mWidth + x;
            const glm::dvec3 eye = mLine.at(alongAt(x)).place, place(mPlaces[at]);
            glm::dvec3 normal(glm::normalize(mNormals[at]));
            // Wall that faces away from the line, behind folds and thin flesh, is shown here too: it is lit
            // from its own side.
            if (glm::dot(normal, eye - place) < 0) normal = -normal;
            picture.at(x, y) =
                packColor(glm::vec3(shadePlain(look, place, normal, eye, eye, glm::dvec3(look.surface))));
        }
    });
    // Outlines two pixels wide: marked pixels beside unmarked ones.
    for (const Mark& mark : marks) {
        const auto has = [&](int x, int y) {
            return x >= 0 && y >= 0 && x < mWidth && y < mHeight && vertexAt(x, y) != kNone &&
                   std::binary_search(mark.vertices.begin(), mark.vertices.end(), vertexAt(x, y));
        };
        int low = mWidth, high = 0;
        for (const std::uint32_t v : mark.vertices) {
            const int x = static_cast<int>(pixelOf(v).x);
            low = std::min(low, x - 3), high = std::max(high, x + 3);
        }
        for (int x = std::max(low, 0); x <= std::min(high, mWidth - 1); ++x)
            for (int y = 0; y < mHeight; ++y)
                if (!has(x, y) && (has(x - 1, y) || has(x + 1, y) || has(x, y - 1) || has(x, y + 1) ||
                                   has(x - 2, y) || has(x + 2, y) || has(x, y - 2) || has(x, y + 2)))
                    picture.at(x, y) = packColor(mark.color);
    }
    for (int mark = 0; mark * kSquare <= mLine.length(); ++mark) {
        const int x = static_cast<int>(std::lround(columnAt(mark * kSquare)));
        const int tall = mark % 10 == 0 ? kMark : kMark / 2;
        for (int y = 0; y < tall && x < mWidth; ++y) picture.at(x, scale + y) = black;
    }
    for (int x = static_cast<int>(columnAt(0)); x <= columnAt(mLine.length()); ++x)
        picture.at(x, scale) = black;
    const int top = scale + 2 * kMark;
    for (int n = 0; n <= square; ++n)
        picture.at(n, top) = picture.at(n, top + square) = picture.at(0, top + n) =
            picture.at(square, top + n) = black;
    return picture;
}

// Returns for each square of `side` pixels the area of the wall shown in it, divided by the square's own
// area; -1 where the square is not completely inside the picture.
std::vector<float> UnfoldedWall::densities(int side) const {
    const int columns = mWidth / side, rows = mHeight / side;
    std::vector<float> density(static_cast<std::size_t>(columns) * rows, 0);
    const double own = static_cast<double>(side) * side * mSetting.pixel * mSetting.pixel;
    for (std::uint32_t v = 0; v < mAlong.size(); ++v) {
        const glm::dvec2 p = pixelOf(v);
        const auto column = std::lround(std::max(p.x, 0.0)) / side,
                   row = std::lround(std::max(p.y, 0.0)) / side;
        if (column < columns && row < rows)
            density[static_cast<std::size_t>(row) * columns + column] +=
                static_cast<float>(mMesh.areas[v] / own);
    }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            for (int x = column * side; x < (column + 1) * side; ++x)
                if (0.5 * mHeight - halfAt(x) > row * side || 0.5 * mHeight + halfAt(x) < (row + 1) * side)
                    density[static_cast<std::size_t>(row) * columns + column] = -1;
    return density;
}

UnfoldedWall::AreaError UnfoldedWall::areaError() const {
    const int side = std::max(static_cast<int>(std::lround(kSquare / mSetting.pixel)), 1);
    std::vector<double> off;
    AreaError error;
    for (const float density : densities(side)) {
        if (density < 0) continue;
        off.push_back(std::abs(density - 1.0));
        error.mean += off.back();
    }
    error.squares = static_cast<int>(off.size());
    if (off.empty()) return error;
    error.mean /= static_cast<double>(off.size());
    const auto most = off.begin() + static_cast<std::ptrdiff_t>((off.size() - 1) * 95 / 100);
    std::nth_element(off.begin(), most, off.end());
    error.most95 = *most;
    return error;
}

Plane<PackedColor> UnfoldedWall::distortionMap() const {
    const int side = std::max(static_cast<int>(std::lround(kSquare / mSetting.pixel)), 1);
    const int columns = mWidth / side, rows = mHeight / side;
    const std::vector<float> density = densities(side);
    Plane<PackedColor> map(mWidth, mHeight);
    for (int y = 0; y < mHeight; ++y)
        for (int x = 0; x < mWidth; ++x) {
            const int column = x / side, row = y / side;
            const float here = column < columns && row < rows
                                   ? density[static_cast<std::size_t>(row) * columns + column]
                                   : -1;
            glm::vec3 color(1);
            if (here >= 0) {
                // A square that shows less wall than its own area enlarges it.
                const float larger = glm::clamp(-std::log2(std::max(here, 1e-3f)), -1.0f, 1.0f);
                const glm::vec3 grey(0.4f), red(0.8f, 0.05f, 0.02f), blue(0.02f, 0.08f, 0.8f);
                color = glm::mix(grey, larger > 0 ? red : blue, std::abs(larger));
            }
            map.at(x, y) = packColor(color);
        }
    return map;
}

UnfoldedWall::Shown UnfoldedWall::shown(const MeasuredPolyp& polyp) const {
    const auto ofHead = [&](int x, int y) {
        const std::uint32_t v = vertexAt(x, y);
        return v != kNone && std::binary_search(polyp.vertices.begin(), polyp.vertices.end(), v);
    };
    double seen = 0, all = 0;
    int low = mWidth, high = 0;
    for (const std::uint32_t v : polyp.vertices) {
        const int x = static_cast<int>(pixelOf(v).x);
        all += mMesh.areas[v];
        if (!hidden(v, 0.002)) seen += mMesh.areas[v];
        low = std::min(low, x - 3), high = std::max(high, x + 3);
    }
    low = std::max(low, 0), high = std::min(high, mWidth - 1);
    std::vector<std::pair<int, int>> pixels;
    for (int x = low; x <= high; ++x)
        for (int y = 0; y < mHeight; ++y)
            if (ofHead(x, y)) pixels.emplace_back(x, y);
    std::vector<std::uint8_t> open(pixels.size(), 1);
    Shown result;
    if (!(all > 0)) return result;
    result.share = seen / all;
    result.area = static_cast<double>(pixels.size()) * mSetting.pixel * mSetting.pixel / all;
    // A head that is cut by the picture's upper edge continues at its lower edge.
    const auto joined = [&](const std::pair<int, int>& a, const std::pair<int, int>& b) {
        const int dx = std::abs(a.first - b.first), dy = std::abs(a.second - b.second);
        return dx <= 2 && (dy <= 2 || std::abs(dy - mTall[a.first]) <= 4);
    };
    for (std::size_t start = 0; start < pixels.size(); ++start) {
        if (!open[start]) continue;
        std::vector<std::size_t> piece{start};
        open[start] = 0;
        for (std::size_t n = 0; n < piece.size(); ++n)
            for (std::size_t k = 0; k < pixels.size(); ++k)
                if (open[k] && joined(pixels[piece[n]], pixels[k])) open[k] = 0, piece.push_back(k);
        result.pieces += piece.size() * 10 >= pixels.size();
    }
    return result;
}

}  // namespace stereonav
