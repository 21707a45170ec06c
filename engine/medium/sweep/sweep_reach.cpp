// A tile's rays lie between those of its corners, and lines stay lines in the light's buffer: between two
// planes the corners' places there bound what the tile reads.
#include "engine/medium/sweep/sweep_reach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostHeld = 16u << 20;  // bytes
constexpr double kMargin = 1.5;               // texels: bilinear reads, and roundings

int tilesOver(int length, int side) {
    return (length + side - 1) / side;
}

}  // namespace

// Rays through the corners of a tile, in the light's buffer: at t along the axis (x, y, w) = from + t by.
struct SweepReach::Looking {
    glm::dvec3 from[4], by[4];
    const RayFan* light = nullptr;
    bool crosses = true;  // all of them cross the slabs
};

void SweepReach::start(const SweepGeometry& geometry, const SweepSpace* space, int chunk, int eyeSide,
                       int lightSide) {
    mChunk = chunk;
    mChunks = tilesOver(geometry.slabs(), chunk);
    mSide = lightSide;
    mAcross = tilesOver(geometry.light.width, lightSide);
    mDown = tilesOver(geometry.light.height, lightSide);
    mFirstTile.clear();
    std::size_t tiles = 0;
    for (const RayFan& eye : geometry.eyes) {
        mFirstTile.push_back(static_cast<int>(tiles));
        tiles += static_cast<std::size_t>(tilesOver(eye.width, eyeSide)) * tilesOver(eye.height, eyeSide);
    }
    const std::size_t lights = static_cast<std::size_t>(mAcross) * mDown, chunks = mChunks;
    mRects.clear();
    if (chunks * (tiles * sizeof(Rect) + lights * sizeof(std::uint32_t)) > kMostHeld || mAcross > 256 ||
        mDown > 256)
        return;
    mRects.resize(tiles * chunks);
    mGone.assign(tiles, 0);
    mEnd.assign(tiles, 0);
    const std::vector<RayFan>& eyes = geometry.eyes;
    const bool alike = eyes.size() == 2 && eyes[0].width == eyes[1].width && eyes[0].height == eyes[1].height;
    mPaired = alike ? tilesOver(eyes[0].width, eyeSide) : 0;
    for (std::size_t n = 0; n < geometry.eyes.size(); ++n) {
        const RayFan& eye = geometry.eyes[n];
        parallelFor(tilesOver(eye.width, eyeSide) * tilesOver(eye.height, eyeSide), [&](int tile) {
            findRects(geometry, space, eye, eyeSide, tile,
                      mRects.data() + (static_cast<std::size_t>(mFirstTile[n]) + tile) * chunks);
        });
    }
    for (std::size_t tile = 0; tile < tiles; ++tile)
        for (std::size_t c = 0; c < chunks; ++c)
            if (mRects[tile * chunks + c].x0 <= mRects[tile * chunks + c].x1)
                mEnd[tile] = static_cast<int>(c) + 1;
    mCount.assign(chunks * lights, 0);
    parallelFor(mChunks, [&](int c) {
        for (std::size_t tile = 0; tile < tiles; ++tile) count(c, mRects[tile * chunks + c], 1);
    });
    mLast.assign(lights, mChunks - 1);
}

void SweepReach::findRects(const SweepGeometry& geometry, const SweepSpace* space, const RayFan& eye,
                           int eyeSide, int tile, Rect* rects) const {
    const int across = tilesOver(eye.width, eyeSide);
    const int column = tile % across, row = tile / across;
    const double x = column * eyeSide, y = row * eyeSide;
    const RayFan& light = geometry.light;
    Looking looking;
    looking.light = &light;
    const double start = glm::dot(eye.origin, geometry.axis);
    for (int n = 0; n < 4; ++n) {
        const glm::dvec3 ray = eye.direction(x + (n & 1 ? eyeSide : 0), y + (n & 2 ? eyeSide : 0));
        const double along = glm::dot(ray, geometry.axis);
        looking.crosses = looking.crosses && (geometry.forward ? along : -along) > kLeastCosine;
        const glm::dvec3 way = ray / along, from = eye.origin - start * way - light.origin;
        const auto seen = [&](const glm::dvec3& v, double w) {
            return glm::dvec3(glm::dot(v, light.right), glm::dot(v, light.up),
                              light.parallel ? w : glm::dot(v, light.forward));
        };
        looking.from[n] = seen(from, 1);
        looking.by[n] = seen(way, 0);
    }
    SweepBeam beam;
    if (space) beam = space->beamOf(geometry, eye, geometry.forward, x, y, x + eyeSide, y + eyeSide);
    for (int c = 0; c < mChunks; ++c) {
        double near = geometry.faces[static_cast<std::size_t>(c) * mChunk],
               far = geometry.faces[std::min((c + 1) * mChunk, geometry.slabs())];
        (geometry.forward ? near : far) =
            geometry.forward ? std::max(near, start) : std::min(far, start);  // rays begin at the eye
        if (!(near < far) || (space && !space->mayMeet(beam, near, far))) continue;
        rects[c] = rectOf(looking, near, far);
    }
}

SweepReach::Rect SweepReach::rectOf(const Looking& looking, double near, double far) const {
    const RayFan& light = *looking.light;
    const Rect all{0, 0, static_cast<std::uint8_t>(mAcross - 1), static_cast<std::uint8_t>(mDown - 1)};
    if (!looking.crosses) return all;
    double x0 = 1e30, x1 = -1e30, y0 = 1e30, y1 = -1e30;
    for (int n = 0; n < 8; ++n) {
        const glm::dvec3 at = looking.from[n / 2] + (n & 1 ? far : near) * looking.by[n / 2];
        if (!(at.z > 1e-9)) return all;  // beside a lamp, or behind it
        const double x = (at.x / at.z - light.xMin) / light.perX, y = (light.yMax - at.y / at.z) / light.perY;
        if (!(std::abs(x) < 1e9 && std::abs(y) < 1e9)) return all;
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
    }
    // Outside the buffer the nearest texels are read.
    const auto tileOf = [&](double texel, int tiles) {
        return static_cast<std::uint8_t>(std::clamp(std::floor(texel / mSide), 0.0, tiles - 1.0));
    };
    return {tileOf(x0 - kMargin, mAcross), tileOf(y0 - kMargin, mDown), tileOf(x1 + kMargin, mAcross),
            tileOf(y1 + kMargin, mDown)};
}

void SweepReach::count(int chunk, const Rect& rect, int by) {
    for (int y = rect.y0; y <= rect.y1; ++y)
        for (int x = rect.x0; x <= rect.x1; ++x)
            mCount[(static_cast<std::size_t>(chunk) * mDown + y) * mAcross + x] +=
                static_cast<std::uint32_t>(by);
}

void SweepReach::drop(std::size_t eye, int tile) {
    if (!known()) return;
    const std::size_t n = static_cast<std::size_t>(mFirstTile[eye]) + tile;
    if (mGone[n]) return;
    mGone[n] = 1;
    if (mPaired == 0 || eye != 0) release(n);
}

void SweepReach::release(std::size_t n) {
    for (int c = 0; c < mChunks; ++c) count(c, mRects[n * mChunks + c], -1);
}

// Releases the rows of the first eye of two that are over.
void SweepReach::releaseRows(int chunk) {
    const auto second = static_cast<std::size_t>(mFirstTile[1]), across = static_cast<std::size_t>(mPaired);
    for (std::size_t row = 0; row < second; row += across) {
        bool over = true;
        for (std::size_t n = row; n < row + across; ++n)
            over = over && (mGone[second + n] || mEnd[second + n] <= chunk);
        for (std::size_t n = row; over && n < row + across; ++n)
            if (mGone[n] == 1) {
                release(n);
                mGone[n] = 2;
            }
    }
}

void SweepReach::begin(int chunk) {
    if (mPaired > 0) releaseRows(chunk);
    const std::size_t lights = mLast.size();
    for (std::size_t n = 0; n < lights; ++n)
        while (mLast[n] >= chunk && mCount[mLast[n] * lights + n] == 0) --mLast[n];
}

std::size_t SweepReach::heldBytes() const {
    return mRects.capacity() * sizeof(Rect) + mGone.capacity() + mEnd.capacity() * sizeof(int) +
           mCount.capacity() * sizeof(std::uint32_t) + mLast.capacity() * sizeof(int);
}

}  // namespace stereonav
