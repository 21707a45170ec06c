// Irradiance or transfer computed while one flies (Wyman et al. 2006, section 4.2; Y6 of docs/ledger.md):
// threads of low priority light the texels near what is seen, coarse first, and write them where frames look
// them up. Nothing here makes a frame wait: whoever asks swaps a list and goes on. Other than the paper's,
// which lights texels when a ray first meets them, and so makes the ray wait.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "engine/light/bake/bake_job.h"

namespace stereonav {

struct LazyBakeSetting {
    int samples = 64;   // samples of a texel before others get more
    int refineTo = 64;  // most samples, reached in doubling passes
    int threads = 1;
    BakeShape shape{};  // irradiance, or transfer, which setLight() lights
};

class LazyBake {
public:
    // volume, the choice's region, what the source refers to, and `to` must outlive this. Texels of `to` that
    // are known with weight 1 already stay as they are. Of the source the function for the setting's shape is
    // used.
    LazyBake(const GreyVolume& volume, const TexelChoice& choice, BakeSource source, IlluminationVolume& to,
             const LazyBakeSetting& setting = {});
    // Ends promptly: waits for some milliseconds' work at most.
    ~LazyBake();
    LazyBake(const LazyBake&) = delete;
    LazyBake& operator=(const LazyBake&) = delete;

    // Asks for bricks near what is seen by their numbers (x + bricks.x (y + bricks.y z)), the most wanted
    // first: replaces what was asked before, whose work is left where it is. Any thread; returns at once. The
    // same list again disturbs nothing; numbers beyond the grid are passed over.
    void request(std::vector<std::uint32_t> bricks);
    // Sets other surfaces that are shown: other texels are wanted. What is lit stays so, as a texel's light
    // is that of the surface through itself.
    void setChoice(const TexelChoice& choice);

    // Sets the sky over transfer, order^2 harmonics; none at first: black. What is lit so far is dotted with
    // it at once, some nanoseconds a texel. Any thread, between frames.
    void setLight(std::vector<glm::vec3> light);

    // Counts changes of texels: a frame drawn since the last one need not be drawn again.
    std::uint64_t changes() const { return mChanges; }
    // Texels lit so far by own samples.
    std::uint64_t texelsLit() const { return mTexelsLit; }
    // Returns whether all texels that were asked for are lit.
    bool done() const;
    // Waits until done(), at most `seconds`; returns done().
    bool waitUntilDone(double seconds);

private:
    struct Brick;
    struct Shown;
    struct Borrowed {
        std::uint16_t to, from;  // texels of a brick
        float weight;
    };
    // The bricks and texels to be lit; replaced as a whole.
    struct Wish {
        std::shared_ptr<const std::vector<std::uint32_t>> bricks;
        std::shared_ptr<const TexelChooser> chooser;
        std::uint64_t choice = 0;
    };
    enum class Pick { Found, OthersAreBusy, NothingLeft };
    struct Task {
        Brick* brick = nullptr;
        int level = 0;
        std::uint64_t version = 0;
        std::shared_ptr<const TexelChooser> chooser;
    };

    void change(const std::shared_ptr<const std::vector<std::uint32_t>>& bricks,
                const std::shared_ptr<const TexelChooser>& chooser);
    void work(const std::stop_token& stop);
    Pick pick(Task& task);
    bool pickAtLevel(int level, Task& task);
    void takeWish();
    Brick& brickAt(std::uint32_t number);
    void wait(Pick found, std::uint64_t seen, const std::stop_token& stop);
    bool light(const Task& task, const std::stop_token& stop);
    bool lightTexels(const Task& task, const std::vector<int>& texels, const std::stop_token& stop);
    void giveBack(const Task& task, bool finished);
    int levels() const;
    std::uint32_t samplesAt(int level) const;
    void choose(const Task& task);
    std::vector<int> texelsAt(const Brick& brick, int level) const;
    bool transfers() const { return mSetting.shape.kind == BakeKind::Transfer; }
    std::uint32_t endOfBatch(std::uint32_t first, std::uint32_t target) const;
    void addSamples(Brick& brick, const std::vector<int>& texels, std::uint32_t first, std::uint32_t end);
    void addTransfer(Brick& brick, const std::vector<int>& texels, std::uint32_t first, std::uint32_t end);
    void publish(Brick& brick, const std::vector<int>& texels);
    void publishTransfer(Brick& brick, int level);
    std::unique_ptr<Shown> shownOf(const Brick& brick) const;
    void show(const Shown& shown);
    std::vector<Borrowed> borrowers(const Brick& brick, int level) const;
    PackedTexel load(std::uint32_t brick, int texel) const;
    void store(std::uint32_t brick, int texel, PackedTexel value);

    const GreyVolume& mVolume;
    const BakeSource mSource;
    IlluminationVolume& mTo;
    const LazyBakeSetting mSetting;

    // The wish: held for swapping alone.
    mutable std::mutex mWishMutex;
    Wish mWish;
    std::atomic<std::uint64_t> mVersion = 0;
    std::uint64_t mDoneVersion = 0;
    std::condition_variable_any mWake, mDone;

    // Workers among themselves.
    std::mutex mPickMutex;
    Wish mNow;
    std::uint64_t mNowVersion = 0;
    std::vector<std::size_t> mCursor;  // by level: next in the list
    int mBusy = 0;
    bool mPassedOver = false;                     // some brick was busy when its turn came
    std::vector<std::unique_ptr<Brick>> mBricks;  // by number

    // Guards transfer's light: held while a brick's texels are dotted, or after another light was set all of
    // them.
    std::mutex mLightMutex;
    std::vector<glm::vec3> mLight;               // order^2 harmonics of the sky, linear RGB
    std::vector<std::unique_ptr<Shown>> mShown;  // by brick

    std::atomic<std::uint64_t> mChanges = 0, mTexelsLit = 0;
    std::vector<std::jthread> mThreads;  // last: they end first
};

}  // namespace stereonav
