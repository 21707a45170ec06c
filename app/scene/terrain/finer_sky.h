// Openness of a ground at more samples than could be looked at before the first picture, worked out while its
// pictures are shown, and kept in the cache for the next time. On one thread, which gives way to those that
// make frames.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/progress.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class FinerSky {
public:
    // ground must outlive this object and not change.
    explicit FinerSky(const Heightfield& ground);
    ~FinerSky();  // returns promptly
    FinerSky(const FinerSky&) = delete;
    FinerSky& operator=(const FinerSky&) = delete;

    struct Openness {
        std::vector<std::uint8_t> samples;  // those of spreadOpenness()
        int width = 0, height = 0;          // samples that horizons were looked for at
    };

    void begin();  // later calls do nothing
    // Returns what has come since the last call.
    std::optional<Openness> take();
    std::uint64_t count() const { return mCount; }  // grows as openness comes
    // Whether no more will come: all is done, or memory does not suffice.
    bool done() const { return mDone; }

    // Largest number of samples in each step.
    static constexpr double kMostSamples[] = {100e3, 800e3};

private:
    void work();

    const Heightfield& mGround;
    std::mutex mMutex;
    std::optional<Openness> mNewest;
    std::atomic<std::uint64_t> mCount = 0;
    std::atomic<bool> mStop = false, mDone = false;
    std::shared_ptr<Progress> mProgress;
    std::thread mThread;
};

}  // namespace stereonav
