// See the header. Which tiles concern a slab is found first, by their boxes among the cells.
#include "engine/medium/sweep/sweep_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kLightSide = LightTile::kSide, kStrips = kLightSide / LightTile::kStrip;
constexpr unsigned kAllStrips = (1u << kStrips) - 1;
constexpr int kBorder = 16;                       // columns of 1 to both sides of a plane
constexpr std::size_t kMostPacked = 32u << 20;    // bytes that the eyes' light may take
constexpr std::size_t kMostStrips = 64u << 20;    // tiles of all slabs that are remembered
constexpr std::uint32_t kAllLight = 0x7fff7fffu;  // both halves 1
constexpr int kPieces = 16;                       // pieces of a slab's tiles, for threads
constexpr double kSigmas = 5;                     // light that spreads further is below 1e-6 of what there is

constexpr int kLineNumbers =
    16;  // numbers of a cache line: rows start with one, so that no packet lies across two

// Returns the first number that starts a cache line.
template <typename T>
T* linesOf(std::vector<T>& numbers) {
    const std::size_t bytes = kLineNumbers * sizeof(T),
                      past = reinterpret_cast<std::uintptr_t>(numbers.data()) % bytes;
    return numbers.data() + (past ? (bytes - past) / sizeof(T) : 0);
}

std::int32_t strideOf(int width) {
    return (width + kLightSide - 1) / kLightSide * kLightSide + 2 * kBorder;
}

// Largest of each tile's neighbourhood, along one axis and then the other.
void spreadLargest(std::vector<int>& values, int across, int down, int reach) {
    std::vector<int> rows(values.size());
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            const int* row = values.data() + static_cast<std::ptrdiff_t>(y) * across;
            rows[static_cast<std::size_t>(y) * across + x] =
                *std::max_element(row + std::max(x - reach, 0), row + std::min(x + reach + 1, across));
        }
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            int most = -1;
            for (int j = std::max(y - reach, 0); j < std::min(y + reach + 1, down); ++j)
                most = std::max(most, rows[static_cast<std::size_t>(j) * across + x]);
            values[static_cast<std::size_t>(y) * across + x] = most;
        }
}

}  // namespace

void SweepLightBuffers::setPlanes(SweepLight& light) {
    const std::int32_t stride = strideOf(light.width);
    mPlanes.assign(7 * static_cast<std::size_t>(stride) * (light.height + 4) + kLineNumbers, 1.0f);
    light.stride = stride;
    light.direct = linesOf(mPlanes) + stride + kBorder;
    mSwapped = false;
}

// Makes room for columns -1 to width + 1 of rows -1 to height + 1.
void SweepLightBuffers::setPacked(SweepLight& light) {
    light.packedStride = (light.width + 4 + kLineNumbers - 1) / kLineNumbers * kLineNumbers;
    light.packedPlane = static_cast<std::int64_t>(light.packedStride) * (light.height + 3) + kLineNumbers;
    if (mPackedWidth != light.width || mPackedHeight != light.height) {
        const std::size_t bytes = 2 * sizeof(std::uint32_t) * static_cast<std::size_t>(light.packedPlane);
        mChunk = static_cast<int>(std::clamp<std::size_t>(kMostPacked / bytes, 1, SweepChunk::kMost));
        mPacked.assign(
            static_cast<std::size_t>(light.packedPlane) * 2 * mChunk + (kBorder + 2 * kLineNumbers),
            kAllLight);
        mPackedWidth = light.width;
        mPackedHeight = light.height;
        mRingSet = false;
    }
    light.packed = linesOf(mPacked) + kLineNumbers - 1;  // column 0 starts a line
}

// Sets the scattered light to what it starts with, in both of the buffers that take turns.
void SweepLightBuffers::setStart(const SweepLight& light) {
    const std::size_t plane = static_cast<std::size_t>(light.stride) * (light.height + 4);
    for (int y = -1; y <= light.height; ++y)
        for (int x = -1; x <= light.width; ++x) {
            const float value = mStart[static_cast<std::size_t>(y + 1) * (light.width + 2) + x + 1];
            if (value == 1) continue;
            const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * light.stride + x;
            for (std::size_t k = 1; k <= 6; ++k)
                light.direct[static_cast<std::ptrdiff_t>(k * plane) + at] = value;
            const int i = std::clamp(x, 0, light.width - 1), j = std::clamp(y, 0, light.height - 1);
            mTouched[static_cast<std::size_t>(j / kLightSide) * mAcross + i / kLightSide] = 1;
        }
}

// Sets the ring of texels around those that are kept for the eyes.
void SweepLightBuffers::setRing(const SweepLight& light) {
    const auto set = [&](int x, int y) {
        const float value =
            mStart.empty() ? 1.0f : mStart[static_cast<std::size_t>(y + 1) * (light.width + 2) + x + 1];
        const auto half = static_cast<std::uint32_t>(value * 32767 + 0.5f);
        const std::int64_t at = static_cast<std::int64_t>(y + 1) * light.packedStride + x + 1;
        for (int n = 0; n < mChunk; ++n) {
            std::uint32_t* first = light.packed + n * (2 * light.packedPlane) + at;
            first[0] = 0x7fffu | half << 16;
            first[light.packedPlane] = half | half << 16;
        }
    };
    for (int x = -1; x <= light.width; ++x) {
        set(x, -1);
        set(x, light.height);
    }
    for (int y = 0; y < light.height; ++y) {
        set(-1, y);
        set(light.width, y);
    }
    mRingSet = !mStart.empty();
}

// Checks the memory of the planes, what is kept for the eyes, its columns and the strips.
void SweepLightBuffers::checkMemoryFor(const SweepLight& light, bool leans, bool columns, int slabs) {
    const double texels = static_cast<double>(strideOf(light.width)) * (light.height + 4);
    const double kept =
        8 * texels * std::clamp(std::floor(kMostPacked / (8 * texels)), 1.0, 1.0 * SweepChunk::kMost);
    const double needed = texels * sizeof(float) * ((leans ? 10 : 7) + 1) + kept * (columns ? 1.5 : 1) +
                          std::min(1.0 * slabs * tiles(), 1.0 * kMostStrips);
    if (needed <= mAskedFor) return;
    checkMemory(fmt::format("light in a medium, {} x {} texels", light.width, light.height), needed,
                "give a smaller --light-size");
    mAskedFor = needed;
}

int SweepLightBuffers::start(SweepScene& scene, const SweepGeometry& geometry, const SweepSpace* space) {
    mAcross = (scene.light.width + kLightSide - 1) / kLightSide;
    mDown = (scene.light.height + kLightSide - 1) / kLightSide;
    const bool scattered = scene.look.model == static_cast<int>(MediumModel::Indirect);
    mLeans = scattered && scene.light.leaning > 0 && scene.light.blur > 0;
    checkMemoryFor(scene.light, mLeans, scene.gridAlone, geometry.slabs());
    setPlanes(scene.light);
    setPacked(scene.light);
    mTouched.assign(tiles(), 0);
    mStart = scattered ? scatteredAtStart(geometry) : std::vector<float>{};
    if (!mStart.empty()) setStart(scene.light);
    mDeep.assign(tiles(), 0);
    if (mLeans)
        mDepths.assign(
            3 * static_cast<std::size_t>(scene.light.stride) * (scene.light.height + 4) + kLineNumbers, 0.0f);
    if (!mStart.empty() || mRingSet) setRing(scene.light);
    findStrips(geometry, space);
    return mChunk;
}

// Strips of a tile, with a texel around each, that meet cells which may not be empty.
void SweepLightBuffers::findStripsOf(const SweepGeometry& geometry, const SweepSpace& space, int tile,
                                     const std::vector<double>& middles) {
    const int column = tile % mAcross, row = tile / mAcross;
    const double x0 = column * kLightSide - 1, x1 = x0 + kLightSide + 2, y0 = row * kLightSide - 1;
    const auto beamOf = [&](double top, double bottom) {
        return space.lightBeamOf(geometry, x0, top, x1, bottom);
    };
    const SweepBeam whole = beamOf(y0, y0 + kLightSide + 2);
    SweepBeam beams[kStrips];
    for (int n = 0; n < kStrips; ++n)
        beams[n] = beamOf(y0 + n * LightTile::kStrip, y0 + (n + 1) * LightTile::kStrip + 2);
    mLast[tile] = -1;
    const int slabs = static_cast<int>(middles.size());
    for (int first = 0; first < slabs; first += SweepChunk::kMost) {
        const int count = std::min(SweepChunk::kMost, slabs - first);
        std::uint8_t* strips = mStrips.data() + static_cast<std::size_t>(first) * tiles() + tile;
        const std::uint32_t met = space.planesMet(whole, middles.data() + first, count);
        std::uint32_t parts[kStrips];
        for (int n = 0; n < kStrips; ++n)
            parts[n] = met ? space.planesMet(beams[n], middles.data() + first, count) : 0;
        for (int k = 0; k < count; ++k) {
            unsigned here = 0;
            for (int n = 0; n < kStrips; ++n) here |= (parts[n] >> k & 1u) << n;
            strips[static_cast<std::size_t>(k) * tiles()] = static_cast<std::uint8_t>(here);
            if (here) mLast[tile] = first + k;
        }
    }
}

void SweepLightBuffers::findStrips(const SweepGeometry& geometry, const SweepSpace* space) {
    const int slabs = geometry.slabs();
    mLast.assign(tiles(), slabs);
    mStrips.clear();
    if (!space || static_cast<std::size_t>(slabs) * tiles() > kMostStrips) return;
    mStrips.resize(static_cast<std::size_t>(slabs) * tiles());
    std::vector<double> middles(slabs);
    for (int k = 0; k < slabs; ++k) middles[k] = 0.5 * (geometry.faces[k] + geometry.faces[k + 1]);
    parallelFor(tiles(), [&](int tile) { findStripsOf(geometry, *space, tile, middles); });
}

// Finds the last slab of each tile in which eyes read something.
void SweepLightBuffers::findRead(int first, SweepReach* reach) {
    mRead = mLast;
    if (!reach || !reach->known()) return;
    reach->begin(first / mChunk);
    for (int tile = 0; tile < tiles(); ++tile) mRead[tile] = std::min(mRead[tile], reach->lastRead(tile));
}

// Finds the last slab of each tile in which light is needed: for what eyes read there, and for what lies so
// near that light which spreads from here may get there. Never later than from a slab before: light that
// stays behind is not asked for again.
void SweepLightBuffers::findNeeded(const SweepLight& light, const SweepGeometry& geometry, int slab) {
    mNeeded = mRead;
    const int last = std::min(*std::max_element(mRead.begin(), mRead.end()), geometry.slabs() - 1);
    const double length = std::max(geometry.faces[std::max(last, slab) + 1] - geometry.faces[slab], 0.0);
    // Texels of a lamp differ in size: any may be reached.
    const double spread =
        light.parallel ? std::sqrt(0.5 * length * light.length) * light.blur / light.perX : 1e6;
    const double reach = 1 + kSigmas * spread / kLightSide;
    spreadLargest(mNeeded, mAcross, mDown,
                  static_cast<int>(std::min(std::ceil(reach), 1.0 * std::max(mAcross, mDown))));
}

unsigned SweepLightBuffers::stripsAt(const SweepGeometry& geometry, int slab, int tile) const {
    if (!mStrips.empty()) return mStrips[static_cast<std::size_t>(slab) * tiles() + tile];
    return 0.5 * (geometry.faces[slab] + geometry.faces[slab + 1]) > geometry.lightStart ? kAllStrips : 0;
}

long long SweepLightBuffers::beginChunk(const SweepScene& scene, const SweepGeometry& geometry, int first,
                                        int count, const SweepKernels& kernels, SweepReach* reach) {
    const bool scattered = scene.look.model == static_cast<int>(MediumModel::Indirect);
    findRead(first, reach);
    if (scattered)
        findNeeded(scene.light, geometry, first);
    else
        mNeeded = mRead;
    if (!scene.gridAlone) return 0;
    constexpr std::size_t kTexels = std::size_t{kLightSide} * kLightSide;
    const std::size_t needed = columnsOfTile() * tiles() + kLineNumbers;
    if (mColumns.size() < needed) mColumns.resize(needed);
    std::atomic<long long> texels = 0;
    parallelFor(tiles(), [&](int tile) {
        LightColumns at;
        if (mNeeded[tile] < first) return;
        unsigned any = 0;
        long long strips = 0;
        for (int n = 0; n < count; ++n) {
            at.middle[n] = 0.5 * (geometry.faces[first + n] + geometry.faces[first + n + 1]);
            at.thickness[n] = static_cast<float>(geometry.faces[first + n + 1] - geometry.faces[first + n]);
            at.strips[n] = stripsAt(geometry, first + n, tile);
            any |= at.strips[n];
            strips += std::popcount(at.strips[n]);
        }
        if (!any) return;
        at.x0 = tile % mAcross * kLightSide;
        at.y0 = tile / mAcross * kLightSide;
        at.count = count;
        at.columns = columnsOf(0, at.x0, at.y0);
        at.next = kTexels;
        kernels.findColumns(scene, at);
        texels += strips * kLightSide * LightTile::kStrip;
    });
    return texels;
}

// tau_i at every texel of the slab before light is spread across them; 0 where the slab before left some.
void SweepLightBuffers::findDepths(const SweepScene& scene, const SweepGeometry& geometry,
                                   const LightPass& pass, const SweepKernels& kernels) {
    mTiles.clear();
    for (int tile = 0; tile < tiles(); ++tile) {
        const unsigned here = mNeeded[tile] < pass.slab ? 0u : stripsAt(geometry, pass.slab, tile);
        if (here || mDeep[tile])
            mTiles.push_back({tile % mAcross * kLightSide, tile / mAcross * kLightSide, here, nullptr});
        mDeep[tile] = here != 0;
    }
    const int count = static_cast<int>(mTiles.size()), pieces = std::min(count, kPieces);
    parallelFor(pieces, [&](int piece) {
        for (int n = count * piece / pieces; n < count * (piece + 1) / pieces; ++n) {
            if (scene.gridAlone) mTiles[n].columns = columnsOf(pass.inChunk, mTiles[n].x0, mTiles[n].y0);
            kernels.findDepths(scene, pass, mTiles[n]);
        }
    });
}

// A tile's slabs lie together, and tiles a line apart from where their numbers would meet in the caches.
std::size_t SweepLightBuffers::columnsOfTile() const {
    return static_cast<std::size_t>(kLightSide * kLightSide) * mChunk + kLineNumbers;
}
float* SweepLightBuffers::columnsOf(int inChunk, int x0, int y0) {
    const std::size_t tile = static_cast<std::size_t>(y0 / kLightSide) * mAcross + x0 / kLightSide;
    return linesOf(mColumns) + tile * columnsOfTile() +
           static_cast<std::size_t>(inChunk) * kLightSide * kLightSide;
}

// Chooses tiles where something may be, and those to which light may spread that is needed later.
void SweepLightBuffers::chooseTiles(const SweepGeometry& geometry, int slab, int reach) {
    std::vector<std::uint8_t>& spread = mChanged;
    spread.assign(tiles(), 0);
    for (int tile = 0; tile < tiles(); ++tile) {
        if (!mTouched[tile] && !(mLeans && stripsAt(geometry, slab, tile))) continue;
        const int x = tile % mAcross, y = tile / mAcross;
        for (int j = std::max(y - reach, 0); j < std::min(y + reach + 1, mDown); ++j)
            for (int i = std::max(x - reach, 0); i < std::min(x + reach + 1, mAcross); ++i)
                spread[static_cast<std::size_t>(j) * mAcross + i] = 1;
    }
    mTiles.clear();
    for (int tile = 0; tile < tiles(); ++tile) {
        if (mNeeded[tile] < slab) continue;
        const unsigned here = stripsAt(geometry, slab, tile);
        if (here || spread[tile])
            mTiles.push_back({tile % mAcross * kLightSide, tile / mAcross * kLightSide, here, nullptr});
    }
}

long long SweepLightBuffers::pass(const SweepScene& scene, const SweepGeometry& geometry, int slab,
                                  int inChunk, const SweepKernels& kernels) {
    const SweepLight& light = scene.light;
    const bool scattered = scene.look.model == static_cast<int>(MediumModel::Indirect);
    LightPass pass;
    pass.middle = 0.5 * (geometry.faces[slab] + geometry.faces[slab + 1]);
    if (!(pass.middle > geometry.lightStart) || (scene.gridAlone && !scattered)) return 0;
    pass.thickness = static_cast<float>(geometry.faces[slab + 1] - geometry.faces[slab]);
    pass.slab = slab;
    pass.inChunk = inChunk;
    const std::size_t plane = static_cast<std::size_t>(light.stride) * (light.height + 4);
    for (int k = 0; k < 3; ++k) {
        float* first = light.direct + (1 + k) * plane;
        float* second = first + 3 * plane;
        pass.before[k] = mSwapped ? second : first;
        pass.after[k] = mSwapped ? first : second;
    }
    if (mLeans) {
        for (int k = 0; k < 3; ++k) pass.depths[k] = linesOf(mDepths) + light.stride + kBorder + k * plane;
        findDepths(scene, geometry, pass, kernels);
    }
    // Texels of a lamp differ in size: any may be reached.
    const double offset =
        light.parallel ? std::sqrt(pass.thickness * light.length) * light.blur / light.perX : 1e6;
    const double reach = std::ceil((std::max(offset, 1.0) + 1) / kLightSide);
    chooseTiles(geometry, slab, static_cast<int>(std::min(reach, 1.0 * std::max(mAcross, mDown))));
    const int count = static_cast<int>(mTiles.size()), pieces = std::min(count, kPieces);
    parallelFor(pieces, [&](int piece) {
        for (int n = count * piece / pieces; n < count * (piece + 1) / pieces; ++n) {
            LightTile& tile = mTiles[n];
            if (scene.gridAlone) tile.columns = columnsOf(inChunk, tile.x0, tile.y0);
            mChanged[n] = kernels.lightTile(scene, pass, tile);
        }
    });
    for (int n = 0; n < count; ++n)
        if (mChanged[n]) mTouched[mTiles[n].y0 / kLightSide * mAcross + mTiles[n].x0 / kLightSide] = 1;
    mSwapped = !mSwapped;
    return scene.gridAlone ? 0 : static_cast<long long>(count) * kLightSide * kLightSide;
}

std::size_t SweepLightBuffers::heldBytes() const {
    return (mPlanes.size() + mColumns.size() + mDepths.size()) * sizeof(float) +
           mPacked.size() * sizeof(std::uint32_t) + mStart.size() * sizeof(float) + mStrips.size();
}

}  // namespace stereonav
