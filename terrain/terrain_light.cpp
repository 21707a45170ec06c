// The bake: horizons and direct transfer row by row, then one pass a bounce in which every sample gathers
// what the last pass left on the ground that it sees. A bounce is thus one ray long, however many there are,
// and noise does not grow with them; what path tracing would find at a ray's end by further rays is looked
// up between the baked samples there.
#include "terrain/terrain_light.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/parallel.h"
#include "engine/light/spherical_harmonics.h"
#include "terrain/terrain_transfer.h"

namespace stereonav {
namespace {

constexpr int kBakeVersion = 1;  // of what is baked: a change gives other keys
constexpr int kBand = 16;        // rows between two looks at the progress

void checkRange(const char* name, double value, double low, double high, int step = 1) {
    const bool whole = step <= 1 || std::fmod(value, step) == 0;
    if (value >= low && value <= high && whole) return;
    throw Error("", "",
                fmt::format("{}: expected {:g} to {:g}{}, got {:g}", name, low, high,
                            step > 1 ? fmt::format(" in steps of {}", step) : "", value),
                "leave it out for the default");
}

void checkSettings(const TerrainLightSettings& s) {
    checkRange("order", s.order, 1, kMaxHarmonicsOrder);
    checkRange("bounces", s.bounces, 0, 4);
    checkRange("rays", s.rays, RayPacket::kSize, 65536, RayPacket::kSize);
    checkRange("azimuths", s.azimuths, 8, 64, 4);
    checkRange("stride", s.stride, 1, 1 << 20);
    checkRange("albedo", s.albedo, 0, 1);
}

// Bytes held at once: three transfer fields or the two results, horizons, openness, Embree's vertices.
void checkMemory(const Heightfield& ground, const LightGrid& grid, const TerrainLightSettings& s) {
    const double each = s.kind == TerrainLightKind::Openness
                            ? 1.0 + s.azimuths
                            : 1.0 + s.azimuths + 4 * sizeof(std::int16_t) * lightHarmonics(s.order);
    const double needed = each * static_cast<double>(grid.count()) + 40.0 * ground.width() * ground.height();
    const double there =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (needed <= 0.75 * there) return;
    throw Error("", "",
                fmt::format("light for {}x{} samples needs {:.1f} GB, this machine has {:.1f} GB", grid.width,
                            grid.height, needed / 1e9, there / 1e9),
                "bake at a lower resolution");
}

// Runs work(row) for all rows; the job's share from `from` to `to`.
template <typename Work>
void eachRow(int rows, Progress& progress, double from, double to, const char* what, const Work& work) {
    for (int first = 0; first < rows; first += kBand) {
        progress.report(from + (to - from) * first / rows, what);
        parallelFor(std::min(kBand, rows - first), [&](int k) { work(first + k); });
    }
}

std::int16_t quantized(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, -32767.0f, 32767.0f)));
}

Hash hashOf(const Heightfield& ground) {
    Hash hash;
    hash.add("terrain light").add(std::int64_t{kBakeVersion});
    hash.add(std::int64_t{ground.width()}).add(std::int64_t{ground.height()});
    hash.add(ground.spacing().x).add(ground.spacing().y);
    hash.add(ground.data(), sizeof(float) * static_cast<std::size_t>(ground.width()) * ground.height());
    return hash;
}

class Bake {
public:
    Bake(const Heightfield& ground, const TerrainLightSettings& settings, Progress& progress)
        : mGround(ground), mSettings(settings), mProgress(progress), mGrid(ground, settings.stride) {
        checkSettings(settings);
        checkMemory(ground, mGrid, settings);
    }

    TerrainLight run() {
        mProgress.report(0, "building the ground for rays");
        const GroundRays rays(mGround);
        mLight.settings = mSettings;
        mLight.grid = mGrid;
        mLight.key = terrainLightKey(mGround, mSettings);
        mLight.openness.resize(mGrid.count());
        mLight.horizon.resize(mGrid.count() * mSettings.azimuths);
        const bool transfer = mSettings.kind == TerrainLightKind::Transfer;
        if (transfer) mDirect.resize(mGrid.count() * mCount);
        bakeDirect(rays, transfer ? mSettings.bounces == 0 ? 0.9 : 0.5 : 1.0);
        if (!transfer) {
            mLight.horizon = {};
            return std::move(mLight);
        }
        mTotal = mDirect;
        for (int b = 0; b < mSettings.bounces; ++b) bakeBounce(rays, b);
        intoPlanes();
        return std::move(mLight);
    }

private:
    bool known(int i, int j) const { return std::isfinite(mGround.sample(mGrid.column(i), mGrid.row(j))); }
    std::size_t sampleAt(int i, int j) const { return static_cast<std::size_t>(j) * mGrid.width + i; }
    void setWedges(int i, int j, SkyWedges& wedges) const {
        wedges.set(sampleNormal(mGround, mGrid.column(i), mGrid.row(j)), &mLight.horizon[sampleAt(i, j)],
                   mGrid.count());
    }

    void bakeDirect(const GroundRays& rays, double to) {
        const SkyTransfer sky(mSettings.order, mSettings.azimuths);
        eachRow(mGrid.height, mProgress, 0, to, "casting rays for the horizon", [&](int j) {
            bakeHorizonRow(rays, mGrid, j, mSettings.azimuths, &mLight.horizon[sampleAt(0, j)],
                           mGrid.count());
            SkyWedges wedges(mSettings.azimuths);
            float direct[kMaxHarmonics];
            for (int i = 0; i < mGrid.width; ++i) {
                if (!known(i, j)) continue;
                setWedges(i, j, wedges);
                mLight.openness[sampleAt(i, j)] =
                    static_cast<std::uint8_t>(std::lround(255 * wedges.openness()));
                if (mDirect.empty()) continue;
                sky.direct(wedges, direct);
                for (int k = 0; k < mCount; ++k)
                    mDirect[sampleAt(i, j) * mCount + k] = quantized(direct[k] / mUnit[k]);
            }
        });
    }

    void bakeBounce(const GroundRays& rays, int bounce) {
        const double from = 0.5 + 0.45 * bounce / mSettings.bounces, to = from + 0.45 / mSettings.bounces;
        TransferField next(mTotal.size());
        eachRow(mGrid.height, mProgress, from, to, "casting rays for bounced light", [&](int j) {
            SkyWedges wedges(mSettings.azimuths);
            float bounced[kMaxHarmonics];
            const GatherSetting setting{mSettings.rays, mSettings.albedo, mSettings.seed, mCount};
            for (int i = 0; i < mGrid.width; ++i) {
                if (!known(i, j)) continue;
                setWedges(i, j, wedges);
                gatherBounce(rays, mGrid, i, j, wedges, mTotal, setting, bounced);
                const std::size_t at = sampleAt(i, j) * mCount;
                for (int k = 0; k < mCount; ++k)
                    next[at + k] = quantized(static_cast<float>(mDirect[at + k]) + bounced[k]);
            }
        });
        mTotal = std::move(next);
    }

    void intoPlanes() {
        mProgress.report(0.95, "packing");
        mLight.full.resize(mTotal.size());
        mLight.bounced.resize(mTotal.size());
        parallelFor(mGrid.height, [&](int j) {
            for (int i = 0; i < mGrid.width; ++i)
                for (int k = 0; k < mCount; ++k) {
                    const std::size_t from = sampleAt(i, j) * mCount + k,
                                      to = k * mGrid.count() + sampleAt(i, j);
                    mLight.full[to] = mTotal[from];
                    mLight.bounced[to] = static_cast<std::int16_t>(
                        std::clamp(int{mTotal[from]} - int{mDirect[from]}, -32767, 32767));
                }
        });
    }

    static std::vector<float> units() {
        std::vector<float> all;
        for (int k = 0; k < kMaxHarmonics; ++k) all.push_back(static_cast<float>(transferUnit(k)));
        return all;
    }

    const Heightfield& mGround;
    const TerrainLightSettings mSettings;
    Progress& mProgress;
    const LightGrid mGrid;
    const int mCount = lightHarmonics(mSettings.order);
    const std::vector<float> mUnit = units();
    TerrainLight mLight;
    TransferField mDirect, mTotal;
};

}  // namespace

LightGrid::LightGrid(const Heightfield& ground, int step)
    : groundWidth(ground.width()), groundHeight(ground.height()), stride(std::max(1, step)) {
    const auto count = [&](int samples) { return (samples - 2) / stride + 2; };
    width = count(groundWidth);
    height = count(groundHeight);
}

LightGrid::Place LightGrid::place(double grid, int samples, int count) const {
    const double g = std::clamp(grid, 0.0, samples - 1.0);
    const int index = std::min(static_cast<int>(g / stride), count - 2);
    const int from = at(index, samples), to = at(index + 1, samples);
    return {index, static_cast<float>(std::clamp((g - from) / (to - from), 0.0, 1.0))};
}

int lightHarmonic(int n) {
    int l = 0;
    while (lightHarmonics(l + 1) <= n) ++l;
    return l * l + 2 * (n - lightHarmonics(l));  // m = -l, -l + 2, ..., l
}

double transferUnit(int n) {
    int l = 0;
    while (lightHarmonics(l + 1) <= n) ++l;
    return std::sqrt((2 * l + 1) / (4 * std::numbers::pi)) / 32767;
}

std::filesystem::path terrainLightCache(const Heightfield& ground) {
    return cacheFolder() / fmt::format("terrain_light_{:016x}.light", hashOf(ground).value());
}

std::uint64_t terrainLightKey(const Heightfield& ground, const TerrainLightSettings& s) {
    Hash hash = hashOf(ground);
    for (const std::int64_t value : {static_cast<std::int64_t>(s.kind), std::int64_t{s.order},
                                     std::int64_t{s.bounces}, std::int64_t{s.rays}, std::int64_t{s.azimuths},
                                     std::int64_t{s.stride}, static_cast<std::int64_t>(s.seed)})
        hash.add(value);
    return hash.add(s.albedo).value();
}

TerrainLight bakeTerrainLight(const Heightfield& ground, const TerrainLightSettings& settings,
                              Progress& progress) {
    TerrainLight light = Bake(ground, settings, progress).run();
    progress.report(1, "baked");
    return light;
}

}  // namespace stereonav
