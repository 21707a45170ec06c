#include "app/scene/terrain/finer_sky.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <utility>

#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/lone_loops.h"
#include "engine/base/parallel.h"
#include "engine/base/thread_priority.h"
#include "terrain/light/quick_light.h"

namespace stereonav {
namespace {

std::filesystem::path skyCache(const Heightfield& ground) {
    return keptFile(fmt::format("terrain-sky-{:016x}.bin", terrainLightKey(ground, {})));
}

std::optional<TerrainLight> keptSky(const Heightfield& ground) {
    try {
        const std::filesystem::path file = skyCache(ground);
        std::error_code code;
        if (!std::filesystem::exists(file, code)) return std::nullopt;
        std::optional<TerrainLight> light = loadTerrainLight(file, &ground);
        noteUse(file);
        return light;
    } catch (const Error&) {
        return std::nullopt;  // it is made anew
    }
}

void keepSky(const Heightfield& ground, const TerrainLight& light) {
    try {
        keep(skyCache(ground), [&](const std::filesystem::path& file) { saveTerrainLight(file, light); });
    } catch (const Error&) {
        // There is no folder for it: it is done without.
    }
}

}  // namespace

FinerSky::FinerSky(const Heightfield& ground) : mGround(ground), mProgress(std::make_shared<Progress>()) {}

FinerSky::~FinerSky() {
    mStop = true;
    mProgress->cancel();
    if (mThread.joinable()) mThread.join();
}

void FinerSky::begin() {
    if (!mThread.joinable()) mThread = std::thread([this] { work(); });
}

std::optional<FinerSky::Openness> FinerSky::take() {
    const std::lock_guard lock(mMutex);
    return std::exchange(mNewest, std::nullopt);
}

void FinerSky::work() {
    stepBehindTheWindow();
    stepBehindTheWindow();  // and after the thread that makes frames
    loopOnThisThreadAlone();
    interruptLoopsBy(&mStop);
    const auto show = [this](const TerrainLight& sparse) {
        Openness made{spreadOpenness(mGround, sparse).openness, sparse.grid.width, sparse.grid.height};
        {
            const std::lock_guard lock(mMutex);
            mNewest = std::move(made);
        }
        ++mCount;
    };
    try {
        if (const std::optional<TerrainLight> kept = keptSky(mGround)) {
            show(*kept);
        } else {
            int before = 0;
            for (const double most : kMostSamples) {
                const TerrainLight sparse = sparseOpenness(mGround, most, *mProgress);
                if (sparse.settings.stride == before) break;
                before = sparse.settings.stride;
                show(sparse);
                if (most == kMostSamples[std::size(kMostSamples) - 1] || before == 1) {
                    keepSky(mGround, sparse);
                    break;
                }
            }
        }
    } catch (const std::exception&) {
        // The scene has ended, or memory does not suffice: the ground keeps its light.
    }
    mDone = true;
}

}  // namespace stereonav
