// Openness of a ground at more samples than could be looked at before the first picture, worked out while its
// pictures are shown, and kept in the cache for the next time. On one thread, which gives way to those that
// make frames.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/scene/terrain/behind_frames.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

class FinerSky {
public:
    // ground must outlive this object and not change.
    explicit FinerSky(const Heightfield& ground) : mGround(ground) {}

    struct Openness {
        std::vector<std::uint8_t> samples;  // those of spreadOpenness()
        int width = 0, height = 0;          // samples that horizons were looked for at
    };

    // Begins the work; later calls do nothing.
    void begin() {
        mWork.begin([this] { work(); });
    }
    // Returns what has come since the last call.
    std::optional<Openness> take() { return mWork.take(); }
    std::uint64_t count() const { return mWork.count(); }  // grows as openness comes
    bool done() const { return mWork.done(); }             // whether no more will come

    // Largest number of samples in each step.
    static constexpr double kMostSamples[] = {100e3, 800e3};

private:
    void work();

    const Heightfield& mGround;
    BehindFrames<std::optional<Openness>> mWork;
};

}  // namespace stereonav
