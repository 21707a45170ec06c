#include "terrain/light/fine_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/peers/piece_dealer.h"

namespace stereonav {
namespace {

// Samples around a tile that its rays go over at its own sampling. What a horizon further away loses by
// coarser samples is seen under a small angle.
constexpr int kAround = 256;

// Vectors of one sample after another, from planes.
TransferField sentBy(const TerrainLight& light, int count) {
    const std::size_t samples = light.grid.count();
    TransferField field(light.full.size());
    parallelFor(count, [&](int k) {
        for (std::size_t s = 0; s < samples; ++s) field[s * count + k] = light.full[k * samples + s];
    });
    return field;
}

bool anyKnown(const Heightfield& ground, const LightGrid& grid) {
    for (int j = 0; j < grid.height; ++j)
        for (int i = 0; i < grid.width; ++i)
            if (std::isfinite(ground.sample(grid.column(i), grid.row(j)))) return true;
    return false;
}

const Heightfield& checked(const Heightfield& ground, const TerrainLightSettings& settings) {
    checkMemory("light at finer samples", FineBake::memoryOf(ground, settings), "give more --memory");
    return ground;
}

}  // namespace

double FineBake::memoryOf(const Heightfield& ground, const TerrainLightSettings& settings) {
    constexpr double kSide = kLightTileSide + 2 * kAround, kMaxima = 4 * 4.0 / 3, kTwice = 2;
    const double samples = double(ground.width()) * ground.height(), around = kSide * kSide;
    const double transfer = sizeof(std::int16_t) * lightHarmonics(settings.order);
    const double each = 1 + settings.azimuths + 6 * transfer;
    double bytes = kMaxima * (samples + around) + kTwice * each * kLightTileSide * kLightTileSide;
    if (settings.kind == TerrainLightKind::Transfer && settings.bounces > 0)
        bytes += kTwice * transfer * samples + rayBytes(samples) + rayBytes(around);
    return bytes;
}

FineBake::FineBake(const GroundLevels& levels, const Heightfield& ground, const TerrainLight& light)
    : mLevels(levels),
      mGround(checked(ground, light.settings)),
      mSettings(light.settings),
      mGrid(light.grid),
      mCount(lightHarmonics(light.settings.order)),
      mWhole(ground),
      mSky(mSettings.order, mSettings.azimuths) {
    if (mSettings.kind == TerrainLightKind::Openness || mSettings.bounces == 0) return;
    mSent = sentBy(light, mCount);
    mWholeRays.emplace(ground);
}

std::optional<TerrainLight> FineBake::tile(int level, const glm::ivec2& low, const glm::ivec2& size,
                                           const std::function<void()>& each) const {
    const glm::ivec2 all = mLevels.size(level), from = glm::max(low - kAround, glm::ivec2(0)),
                     to = glm::min(low + size + kAround, all);
    const glm::ivec2 extent = to - from;
    std::vector<float> heights(static_cast<std::size_t>(extent.x) * extent.y);
    mLevels.read(level, from, extent, heights.data());
    if (!Heightfield::anyCell(extent.x, extent.y, heights.data())) return std::nullopt;
    // In a world of its own: near its origin single precision is fine enough for any samples.
    const Heightfield part(extent.x, extent.y, mLevels.spacing(level), std::move(heights), "a level");
    TerrainLight light;
    light.settings = mSettings;
    light.grid = LightGrid(low - from, size);
    const LightGrid& grid = light.grid;
    if (!anyKnown(part, grid)) return std::nullopt;
    const glm::dvec2 offset =
        mLevels.originWorld() + glm::dvec2(from) * mLevels.spacing(level) - part.originWorld();
    const GroundHorizon horizon(part, mWhole, offset);
    const auto width = static_cast<std::size_t>(grid.width);
    const bool transfer = mSettings.kind == TerrainLightKind::Transfer;
    light.openness.assign(grid.count(), 0);
    TransferField direct;
    if (transfer) {
        light.horizon.assign(grid.count() * mSettings.azimuths, 0);
        direct.assign(grid.count() * mCount, 0);
    }
    parallelFor(grid.height, [&](int j) {
        DirectRow row{&light.openness[j * width]};
        if (transfer) {
            row.horizon = &light.horizon[j * width];
            row.planeSize = grid.count();
            row.transfer = &direct[j * width * mCount];
        }
        bakeDirectRow(horizon, grid, j, mSettings.azimuths, transfer ? &mSky : nullptr, row, each);
    });
    if (!transfer) return light;
    TransferField total = direct;
    if (!mSent.empty()) {
        const GroundRays rays(part, *mWholeRays, offset);
        const SentLight sent{mGround, mGrid, mSent, offset};
        const GatherSetting setting{mSettings.rays, mSettings.albedo, mSettings.seed, mCount};
        parallelFor(grid.height, [&](int j) {
            const std::uint64_t number = numberOfSample(level, all, {low.x, low.y + j});
            const std::size_t at = j * width * mCount;
            bakeBounceRow(rays, grid, j, mSettings.azimuths, number, sent, setting,
                          {&light.horizon[j * width], grid.count(), &direct[at], &total[at]}, each);
        });
    }
    packTransfer(direct, total, light);
    return light;
}

std::uint64_t numberOfSample(int level, const glm::ivec2& all, const glm::ivec2& sample) {
    return (static_cast<std::uint64_t>(level) << 56) + static_cast<std::uint64_t>(sample.y) * all.x +
           sample.x;
}

FineLightShape fineLightShape(const GroundLevels& levels, int level, const TerrainLight& light, int finer) {
    FineLightShape shape;
    shape.settings = light.settings;
    shape.key = light.key;
    shape.size = levels.size(0);
    shape.coarsest = level - 1;
    shape.finest = std::max(0, level - finer);
    shape.content = levels.content();
    return shape;
}

void bakeFineLight(const FineBake& bake, const std::filesystem::path& place,
                   const std::filesystem::path& part, const FineLightShape& shape, Progress& progress,
                   Peers& peers) {
    const auto each = [&] {
        if (progress.cancelled()) throw Cancelled();
    };
    const auto made = [&](const LightTiles::Tile& tile, const glm::ivec2& size) {
        const std::optional<TerrainLight> light = bake.tile(tile.level, tile.low(), size, each);
        return light ? bytesOf(*light) : PeerBytes();
    };
    struct Order {
        LightTiles::Tile tile;
        glm::ivec2 size;
    };
    if (!peers.first())
        return peers.serve([&](std::size_t, std::span<const std::byte> bytes) {
            const auto order = ByteReader(bytes).get<Order>();
            return made(order.tile, order.size);
        });
    LightTiles tiles = LightTiles::begin(part, shape);
    std::vector<std::size_t> missing;
    for (std::size_t n = 0; n < tiles.count(); ++n)
        if (!tiles.has(n)) missing.push_back(n);
    std::size_t done = tiles.count() - missing.size();
    progress.report(0, "light at finer samples");
    const auto tell = [&] {
        progress.report(static_cast<double>(done) / static_cast<double>(tiles.count()),
                        fmt::format("light at finer samples, tile {} of {}",
                                    std::min(done + 1, tiles.count()), tiles.count()));
    };
    PieceWork work;
    work.count = missing.size();
    work.order = [&](std::size_t n) {
        const LightTiles::Tile tile = tiles.tile(missing[n]);
        return ByteWriter().put(Order{tile, tiles.sizeOf(tile)}).take();
    };
    work.make = [&](std::size_t n, std::span<const std::byte>) {
        tell();
        const LightTiles::Tile tile = tiles.tile(missing[n]);
        return made(tile, tiles.sizeOf(tile));
    };
    work.take = [&](std::size_t n, std::span<const std::byte> result) {
        tiles.write(missing[n], result);
        ++done;
    };
    PieceDealer(peers).deal(work);
    tell();
    tiles.finish(place);
}

}  // namespace stereonav
