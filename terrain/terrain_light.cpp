// The bake: horizons and direct transfer row by row, then one pass a bounce in which every sample gathers
// what the last pass left on the ground that it sees. A bounce is thus one ray long, however many there are,
// and noise does not grow with them; what path tracing would find at a ray's end by further rays is looked
// up between the baked samples there.
#include "terrain/terrain_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/base/stop.h"
#include "engine/light/spherical_harmonics.h"
#include "terrain/terrain_bake_part.h"
#include "terrain/terrain_transfer.h"

namespace stereonav {
namespace {

constexpr int kBakeVersion = 1;  // of what is baked: a change gives other keys
constexpr int kBand = 16;        // rows between two looks at the progress
constexpr int kLargestStride = 1000;

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
double memoryOf(const Heightfield& ground, const LightGrid& grid, const TerrainLightSettings& s) {
    const double each = s.kind == TerrainLightKind::Openness
                            ? 1.0 + s.azimuths
                            : 1.0 + s.azimuths + 4 * sizeof(std::int16_t) * lightHarmonics(s.order);
    return each * static_cast<double>(grid.count()) + 40.0 * ground.width() * ground.height();
}

void checkMemoryOf(const Heightfield& ground, const LightGrid& grid, const TerrainLightSettings& s) {
    const double needed = memoryOf(ground, grid, s), there = availableMemory();
    if (needed <= there) return;
    const auto fits = [&](int stride) { return memoryOf(ground, LightGrid(ground, stride), s) <= there; };
    int stride = grid.stride;
    while (stride < kLargestStride && !fits(stride)) ++stride;
    throw Error("", "",
                fmt::format("light for {}x{} samples needs {} of memory, and {} can be had", grid.width,
                            grid.height, memoryText(needed), memoryText(there)),
                fits(stride)
                    ? fmt::format("--resolution {:.3f} would fit", std::floor(1000.0 / stride) / 1000)
                    : "no resolution would fit: bake a part of this ground");
}

// Runs work(row) for all rows that are not done; the job's share from `from` to `to`.
template <typename Work>
void eachRow(std::int32_t& done, int rows, Progress& progress, double from, double to, const char* what,
             const Work& work) {
    while (done < rows) {
        progress.report(from + (to - from) * done / rows, what);
        const int band = std::min(kBand, rows - done);
        parallelFor(band, [&](int k) { work(done + k); });
        done += band;
    }
}

template <typename T>
std::span<std::byte> bytesOf(std::vector<T>& values, std::size_t first, std::size_t count) {
    return std::as_writable_bytes(std::span(values).subspan(first, count));
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
    Bake(const Heightfield& ground, const TerrainLightSettings& settings, Progress& progress, bool keeps)
        : mGround(ground),
          mSettings(settings),
          mProgress(progress),
          mGrid(ground, settings.stride),
          mKeeps(keeps) {
        checkSettings(settings);
        checkMemoryOf(ground, mGrid, settings);
    }

    TerrainLight run() {
        try {
            TerrainLight light = bake();
            std::error_code code;
            if (mKeeps) std::filesystem::remove(terrainBakePart(light.key), code);
            return light;
        } catch (const Cancelled&) {
            const FinishingWork keepsWhatIsDone;
            if (mKeeps && (mDone.phase > 0 || mDone.rows > 0)) keepBakePart(mLight.key, mDone, blocksDone());
            throw;
        }
    }

private:
    TerrainLight bake() {
        mProgress.report(0, "building the ground for rays");
        const GroundRays rays(mGround);
        mLight.settings = mSettings;
        mLight.grid = mGrid;
        mLight.key = terrainLightKey(mGround, mSettings);
        const bool transfer = mSettings.kind == TerrainLightKind::Transfer;
        goOn();
        if (mDone.phase == 0) {
            bakeDirect(rays, transfer ? mSettings.bounces == 0 ? 0.9 : 0.5 : 1.0);
            if (transfer) mTotal = mDirect;
            nextPhase();
        }
        if (!transfer) {
            mProgress.report(1, "baked");
            mLight.horizon = {};
            return std::move(mLight);
        }
        while (mDone.phase <= mSettings.bounces) {
            bakeBounce(rays, mDone.phase - 1);
            nextPhase();
        }
        mNext = {};
        intoPlanes();
        mProgress.report(1, "baked");
        return std::move(mLight);
    }

    void nextPhase() {
        ++mDone.phase;
        mDone.rows = 0;
        const bool another = mSettings.kind == TerrainLightKind::Transfer && mDone.phase <= mSettings.bounces;
        if (another) mNext.resize(mTotal.size());
    }

    void allocate() {
        const bool transfer = mSettings.kind == TerrainLightKind::Transfer;
        mLight.openness.assign(mGrid.count(), 0);
        mLight.horizon.assign(mGrid.count() * mSettings.azimuths, 0);
        if (transfer) mDirect.assign(mGrid.count() * mCount, 0);
        if (mDone.phase == 0) return;
        mTotal.resize(mDirect.size());
        mNext.resize(mDirect.size());
    }

    // What was reached, in whole rows: of the first phase, and of the present one.
    BakeBlocks blocksDone() {
        const bool first = mDone.phase == 0;
        const std::size_t row = static_cast<std::size_t>(mGrid.width);
        const std::size_t samples = row * static_cast<std::size_t>(first ? mDone.rows : mGrid.height);
        BakeBlocks blocks{bytesOf(mLight.openness, 0, samples)};
        for (int a = 0; a < mSettings.azimuths; ++a)
            blocks.push_back(bytesOf(mLight.horizon, a * mGrid.count(), samples));
        if (!mDirect.empty()) blocks.push_back(bytesOf(mDirect, 0, samples * mCount));
        if (first) return blocks;
        blocks.push_back(bytesOf(mTotal, 0, mTotal.size()));
        blocks.push_back(bytesOf(mNext, 0, mDone.rows * row * mCount));
        return blocks;
    }

    // From where an earlier run of the same bake was stopped.
    void goOn() {
        if (mKeeps) mDone = keptBakePart(mLight.key);
        const bool transfer = mSettings.kind == TerrainLightKind::Transfer;
        if (mDone.phase < 0 || mDone.phase > (transfer ? mSettings.bounces + 1 : 1) || mDone.rows < 0 ||
            mDone.rows > mGrid.height)
            mDone = {};
        allocate();
        if ((mDone.phase == 0 && mDone.rows == 0) || readBakePart(mLight.key, blocksDone())) return;
        mDone = {};
        allocate();
    }

    bool known(int i, int j) const { return std::isfinite(mGround.sample(mGrid.column(i), mGrid.row(j))); }
    std::size_t sampleAt(int i, int j) const { return static_cast<std::size_t>(j) * mGrid.width + i; }
    void setWedges(int i, int j, SkyWedges& wedges) const {
        wedges.set(sampleNormal(mGround, mGrid.column(i), mGrid.row(j)), &mLight.horizon[sampleAt(i, j)],
                   mGrid.count());
    }

    void bakeDirect(const GroundRays& rays, double to) {
        const SkyTransfer sky(mSettings.order, mSettings.azimuths);
        eachRow(mDone.rows, mGrid.height, mProgress, 0, to, "casting rays for the horizon", [&](int j) {
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
        eachRow(mDone.rows, mGrid.height, mProgress, from, to, "casting rays for bounced light", [&](int j) {
            SkyWedges wedges(mSettings.azimuths);
            float bounced[kMaxHarmonics];
            const GatherSetting setting{mSettings.rays, mSettings.albedo, mSettings.seed, mCount};
            for (int i = 0; i < mGrid.width; ++i) {
                if (!known(i, j)) continue;
                setWedges(i, j, wedges);
                gatherBounce(rays, mGrid, i, j, wedges, mTotal, setting, bounced);
                const std::size_t at = sampleAt(i, j) * mCount;
                for (int k = 0; k < mCount; ++k)
                    mNext[at + k] = quantized(static_cast<float>(mDirect[at + k]) + bounced[k]);
            }
        });
        std::swap(mTotal, mNext);
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
    TransferField mDirect, mTotal, mNext;
    const bool mKeeps;
    BakeReached mDone;
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
                              Progress& progress, bool keeps) {
    return Bake(ground, settings, progress, keeps).run();
}

}  // namespace stereonav
