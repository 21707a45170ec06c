// The bake: horizons and direct transfer row by row, then one pass a bounce in which every sample gathers
// what the last pass left on the ground that it sees. A bounce is thus one ray long, however many there are,
// and noise does not grow with them; what path tracing would find at a ray's end by further rays is looked
// up between the baked samples there.
#include "terrain/light/terrain_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/base/stop.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/peers/piece_dealer.h"
#include "terrain/light/light_rows.h"
#include "terrain/light/terrain_bake_part.h"

namespace stereonav {
namespace {

constexpr int kBakeVersion = 1;  // version of what is baked: a change gives other keys
constexpr int kBand = 16;        // rows between two looks at the progress
constexpr int kLargestStride = 1000;
constexpr std::uint64_t kKeepBytes = 32 << 20;  // done and not kept yet: what a stop has to write at most

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

// Bytes held at once: three transfer fields or the two results, horizons, openness, and either the maxima
// that horizons are found by or, for bounces, what rays take.
double memoryOf(const Heightfield& ground, const LightGrid& grid, const TerrainLightSettings& s) {
    const bool transfer = s.kind == TerrainLightKind::Transfer;
    const double each =
        transfer ? 1.0 + s.azimuths + 4 * sizeof(std::int16_t) * lightHarmonics(s.order) : 1.0;
    const double samples = double(ground.width()) * ground.height(), maxima = 4 * 4.0 / 3 * samples;
    return each * static_cast<double>(grid.count()) +
           (transfer && s.bounces > 0 ? rayBytes(samples) : maxima) + 8e6;
}

std::optional<int> strideFrom(int first, const Heightfield& ground, const TerrainLightSettings& s,
                              double bytes) {
    for (int stride = first; stride <= kLargestStride; ++stride)
        if (memoryOf(ground, LightGrid(ground, stride), s) <= bytes) return stride;
    return std::nullopt;
}

void checkMemoryOf(const Heightfield& ground, const LightGrid& grid, const TerrainLightSettings& s) {
    const double needed = memoryOf(ground, grid, s), there = availableMemoryFor(needed);
    if (needed <= there) return;
    const std::optional<int> stride = strideFrom(grid.stride, ground, s, there);
    throw Error("", "",
                fmt::format("light for {}x{} samples needs {} of memory, and {} is available", grid.width,
                            grid.height, memoryText(needed), memoryText(there)),
                stride ? fmt::format("--resolution {:.3f} would fit", std::floor(1000.0 / *stride) / 1000)
                       : "no resolution would fit: give --tiles on, or bake a part of this ground");
}

template <typename T>
std::span<std::byte> bytesOf(std::vector<T>& values, std::size_t first, std::size_t count) {
    return std::as_writable_bytes(std::span(values).subspan(first, count));
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
    Bake(const Heightfield& ground, const TerrainLightSettings& settings, Progress& progress, bool keeps,
         Peers* peers)
        : mGround(ground),
          mSettings(settings),
          mProgress(progress),
          mGrid(ground, settings.stride),
          mPeers(peers && !peers->alone() ? peers : nullptr),
          mKeeps(keeps && !helps()) {
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
            keepDone();
            throw;
        } catch (const PeerFailure&) {
            keepDone();
            throw;
        }
    }

private:
    // Returns whether this is one of several processes, but not the first: it bakes rows for that one, and
    // keeps nothing.
    bool helps() const { return mPeers && !mPeers->first(); }

    TerrainLight bake() {
        mProgress.report(0, "baking");
        mLight.settings = mSettings;
        mLight.grid = mGrid;
        mLight.key = terrainLightKey(mGround, mSettings);
        goOn();
        if (mPeers) beginAlike();
        if (mDone.phase == 0) {
            bakeDirect(isTransfer() ? mSettings.bounces == 0 ? 0.9 : 0.2 : 1.0);
            nextPhase();
        }
        if (!isTransfer()) {
            mProgress.report(1, "baked");
            return std::move(mLight);
        }
        if (mDone.phase <= mSettings.bounces) bakeBounces();
        mNext = {};
        if (helps()) return std::move(mLight);
        intoPlanes();
        mProgress.report(1, "baked");
        return std::move(mLight);
    }

    bool isTransfer() const { return mSettings.kind == TerrainLightKind::Transfer; }
    int phases() const { return isTransfer() ? mSettings.bounces + 1 : 1; }

    // All rows of the present phase are done.
    void nextPhase() {
        keepDone();
        if (mPeers && mDone.phase + 1 < phases()) pass(blocksOf({mDone.phase, 0, mGrid.height}));
        enterNextPhase();
    }

    void enterNextPhase() {
        if (mDone.phase == 0)
            mTotal = mDirect;
        else
            std::swap(mTotal, mNext);
        ++mDone.phase;
        mDone.rows = mKept.rows = 0;
        mKept.phase = mDone.phase;
        if (mDone.phase < phases()) mNext.resize(mTotal.size());
    }

    void allocate() {
        mLight.openness.assign(mGrid.count(), 0);
        if (!isTransfer()) return;
        mLight.horizon.assign(mGrid.count() * mSettings.azimuths, 0);
        mDirect.assign(mGrid.count() * mCount, 0);
    }

    BakeBlocks blocksOf(const BakeBand& band) {
        const std::size_t row = static_cast<std::size_t>(mGrid.width);
        const std::size_t first = row * static_cast<std::size_t>(band.first),
                          samples = row * static_cast<std::size_t>(band.rows);
        if (band.phase > 0) return {bytesOf(mNext, first * mCount, samples * mCount)};
        BakeBlocks blocks{bytesOf(mLight.openness, first, samples)};
        if (!isTransfer()) return blocks;
        for (int a = 0; a < mSettings.azimuths; ++a)
            blocks.push_back(bytesOf(mLight.horizon, a * mGrid.count() + first, samples));
        blocks.push_back(bytesOf(mDirect, first * mCount, samples * mCount));
        return blocks;
    }

    // Goes on from where an earlier run of the same bake was stopped.
    void goOn() {
        allocate();
        if (!mKeeps) return;
        const BakeKept kept = readBakePart(mLight.key, mGrid.height, phases(), [&](const BakeBand& band) {
            if (band.phase > mDone.phase) {
                mDone.rows = mKept.rows = mGrid.height;
                enterNextPhase();
            }
            return blocksOf(band);
        });
        // A damaged band may have begun a phase: that one is begun all the same.
        if (kept.reached.phase == mDone.phase) mDone.rows = kept.reached.rows;
        mKept = mDone;
        mKeptBytes = kept.bytes;
    }

    BakeBand notKept() const { return {mDone.phase, mKept.rows, mDone.rows - mKept.rows}; }

    // Rows that are done and not kept yet.
    void keepDone() {
        const BakeBand band = notKept();
        if (!mKeeps || mKeepingFailed || band.rows == 0) return;
        mKeptBytes = keepBakeBand(mLight.key, mKeptBytes, band, blocksOf(band));
        mKeepingFailed = mKeptBytes == 0;
        mKept.rows = mDone.rows;
    }

    // Runs work(row) for all rows of the phase that are not done; the job's share from `from` to `to`.
    template <typename Work>
    void eachRow(double from, double to, const char* what, const Work& work) {
        if (helps()) return serveRows(work);
        if (mPeers) return shareRows(from, to, what, work);
        while (mDone.rows < mGrid.height) {
            mProgress.report(from + (to - from) * mDone.rows / mGrid.height, what);
            const int band = std::min(kBand, mGrid.height - mDone.rows);
            parallelFor(band, [&](int k) { work(mDone.rows + k); });
            mDone.rows += band;
            if (bytesPerRow() * static_cast<std::uint64_t>(notKept().rows) >= kKeepBytes) keepDone();
        }
    }

    // Passes blocks from the first process to the others: bytes that all of them have memory for.
    void pass(const BakeBlocks& blocks) {
        constexpr std::size_t kAtOnce = 64 << 20;
        for (const std::span<std::byte> block : blocks)
            for (std::size_t from = 0; from < block.size(); from += kAtOnce) {
                const auto part = block.subspan(from, std::min(kAtOnce, block.size() - from));
                if (helps())
                    ByteReader(mPeers->hear()).getAll(part);
                else
                    mPeers->tellAll({part.begin(), part.end()});
            }
    }

    // An earlier run may have been stopped in any phase: all go on from what the first one holds.
    void beginAlike() {
        std::int32_t phase = mDone.phase;
        pass({std::as_writable_bytes(std::span(&phase, 1))});
        if (phase > 0) pass(blocksOf({0, 0, mGrid.height}));
        if (helps())
            while (mDone.phase < phase) enterNextPhase();
        if (phase > 1) pass({std::as_writable_bytes(std::span(mTotal))});
    }

    BakeBand bandAt(std::size_t piece, int first) const {
        const int from = first + kBand * static_cast<int>(piece);
        return {mDone.phase, from, std::min(kBand, mGrid.height - from)};
    }

    template <typename Work>
    void shareRows(double from, double to, const char* what, const Work& work) {
        const int first = mDone.rows;
        PieceWork rows;
        rows.count = static_cast<std::size_t>((mGrid.height - first + kBand - 1) / kBand);
        rows.inOrder = true;
        rows.ahead = 4 * static_cast<std::size_t>(mPeers->count());
        rows.order = [&](std::size_t n) { return ByteWriter().put(bandAt(n, first)).take(); };
        rows.make = [&](std::size_t n, std::span<const std::byte>) {
            const BakeBand band = bandAt(n, first);
            parallelFor(band.rows, [&](int k) { work(band.first + k); });
            return PeerBytes{};
        };
        rows.take = [&](std::size_t n, std::span<const std::byte> made) {
            mProgress.report(from + (to - from) * mDone.rows / mGrid.height, what);
            const BakeBand band = bandAt(n, first);
            ByteReader reader(made);
            if (!made.empty())
                for (const std::span<std::byte> block : blocksOf(band)) reader.getAll(block);
            mDone.rows += band.rows;
            if (bytesPerRow() * static_cast<std::uint64_t>(notKept().rows) >= kKeepBytes) keepDone();
        };
        PieceDealer(*mPeers).deal(rows);
    }

    template <typename Work>
    void serveRows(const Work& work) {
        mPeers->serve([&](std::size_t, std::span<const std::byte> order) {
            const auto band = ByteReader(order).get<BakeBand>();
            if (band.phase != mDone.phase || band.first < 0 || band.first + band.rows > mGrid.height)
                throw Error("", "bake", "the processes do not find the same ground",
                            "give all the same files");
            parallelFor(band.rows, [&](int k) { work(band.first + k); });
            ByteWriter made;
            for (const std::span<std::byte> block : blocksOf(band))
                made.putAll(std::span<const std::byte>(block));
            return made.take();
        });
    }

    // A row of a large ground takes seconds.
    void lookAtWish() const {
        if (mProgress.cancelled()) throw Cancelled();
    }

    std::uint64_t bytesPerRow() const {
        const std::size_t of = sizeof(std::int16_t) * static_cast<std::size_t>(mCount);
        const std::size_t each = !isTransfer() ? 1 : mDone.phase > 0 ? of : 1 + mSettings.azimuths + of;
        return static_cast<std::uint64_t>(mGrid.width) * each;
    }

    std::size_t firstOf(int j) const { return static_cast<std::size_t>(j) * mGrid.width; }
    void bakeDirect(double to) {
        mProgress.report(to * mDone.rows / mGrid.height, "maxima of the ground");
        const GroundHorizon ground(mGround);
        const SkyTransfer sky(mSettings.order, mSettings.azimuths);
        eachRow(0, to, "looking for horizons", [&](int j) {
            // Openness needs the horizons of a row alone.
            DirectRow row{&mLight.openness[firstOf(j)]};
            if (isTransfer()) {
                row.horizon = &mLight.horizon[firstOf(j)];
                row.planeSize = mGrid.count();
                row.transfer = &mDirect[firstOf(j) * mCount];
            }
            bakeDirectRow(ground, mGrid, j, mSettings.azimuths, isTransfer() ? &sky : nullptr, row,
                          [this] { lookAtWish(); });
        });
    }

    // Returns the share of the job that is done after `bounces` bounces.
    double fromOf(double bounces) const { return 0.2 + 0.75 * bounces / mSettings.bounces; }

    void bakeBounces() {
        const double done = static_cast<double>(mDone.rows) / mGrid.height;
        mProgress.report(fromOf(mDone.phase - 1 + done), "building the ground for rays");
        const GroundRays rays(mGround);
        while (mDone.phase <= mSettings.bounces) {
            bakeBounce(rays, mDone.phase - 1);
            nextPhase();
        }
    }

    void bakeBounce(const GroundRays& rays, int bounce) {
        const double from = fromOf(bounce), to = fromOf(bounce + 1);
        const SentLight sent{mGround, mGrid, mTotal};
        const GatherSetting setting{mSettings.rays, mSettings.albedo, mSettings.seed, mCount};
        eachRow(from, to, "casting rays for bounced light", [&](int j) {
            const std::size_t at = firstOf(j) * mCount;
            const BounceRow row{&mLight.horizon[firstOf(j)], mGrid.count(), &mDirect[at], &mNext[at]};
            bakeBounceRow(rays, mGrid, j, mSettings.azimuths, firstOf(j), sent, setting, row,
                          [this] { lookAtWish(); });
        });
    }

    void intoPlanes() {
        mProgress.report(0.95, "packing");
        packTransfer(mDirect, mTotal, mLight);
    }

    const Heightfield& mGround;
    const TerrainLightSettings mSettings;
    Progress& mProgress;
    const LightGrid mGrid;
    const int mCount = lightHarmonics(mSettings.order);
    TerrainLight mLight;
    TransferField mDirect, mTotal, mNext;
    Peers* const mPeers;  // null: alone
    const bool mKeeps;
    bool mKeepingFailed = false;
    BakeReached mDone, mKept;
    std::uint64_t mKeptBytes = 0;  // bytes of the part's file that hold mKept
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
    return keptFile(fmt::format("terrain_light_{:016x}.light", hashOf(ground).value()));
}

std::uint64_t terrainLightKey(const Heightfield& ground, const TerrainLightSettings& s) {
    Hash hash = hashOf(ground);
    for (const std::int64_t value : {static_cast<std::int64_t>(s.kind), std::int64_t{s.order},
                                     std::int64_t{s.bounces}, std::int64_t{s.rays}, std::int64_t{s.azimuths},
                                     std::int64_t{s.stride}, static_cast<std::int64_t>(s.seed)})
        hash.add(value);
    return hash.add(s.albedo).value();
}

std::optional<int> strideWithinMemory(const Heightfield& ground, const TerrainLightSettings& settings) {
    return strideFrom(1, ground, settings, availableMemory());
}

TerrainLight bakeTerrainLight(const Heightfield& ground, const TerrainLightSettings& settings,
                              Progress& progress, bool keeps, Peers* peers) {
    return Bake(ground, settings, progress, keeps, peers).run();
}

}  // namespace stereonav
