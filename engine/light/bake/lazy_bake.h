// Irradiance or transfer computed during flight (Wyman et al. 2006, section 4.2; Y6 of docs/ledger.md):
// threads of low priority light the texels near what is seen, coarse ones first, and write them where frames
// look them up. No frame waits for this: a request only swaps a list. The paper instead lights texels when a
// ray first meets them, so that the ray waits.
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
    int refineTo = 64;  // largest number of samples, reached in passes that double
    int threads = 1;
    BakeShape shape{};  // irradiance, or transfer, whose light setLight() sets
};

class LazyBake {
public:
    // volume, the choice's region, objects that the source refers to, and `to` must outlive this object.
    // Texels of `to` that already have weight 1 stay as they are. Of the source only the function for the
    // setting's shape is used.
    LazyBake(const GreyVolume& volume, const TexelChoice& choice, BakeSource source, IlluminationVolume& to,
             const LazyBakeSetting& setting = {});
    // Ends promptly: waits at most for some milliseconds of work.
    ~LazyBake();
    LazyBake(const LazyBake&) = delete;
    LazyBake& operator=(const LazyBake&) = delete;

    // Requests bricks near what is seen, by their numbers (x + bricks.x (y + bricks.y z)), the most urgent
    // first. Replaces the previous request, whose work is left as it is; an equal list has no effect. Numbers
    // outside the grid are ignored. Any thread; returns at once.
    void request(std::vector<std::uint32_t> bricks);
    // Sets the surfaces that are shown, which changes the texels that are wanted. Lit texels stay lit, since
    // a texel's light is that of the surface through itself.
    void setChoice(const TexelChoice& choice);

    // Sets the sky whose light transfer shows: order^2 harmonics; black before the first call. Texels that
    // are lit so far are multiplied with it at once, some nanoseconds per texel. Any thread, between frames.
    void setLight(std::vector<glm::vec3> light);

    // Returns a counter of changes to texels: a frame needs to be drawn again only where it has grown.
    std::uint64_t changes() const { return mChanges; }
    // Returns the number of texels that were lit by samples of their own.
    std::uint64_t texelsLit() const { return mTexelsLit; }
    // Returns whether all texels that were asked for are lit.
    bool done() const;
    // Waits until done(), at most `seconds`; returns done().
    bool waitUntilDone(double seconds);

private:
    struct Brick;
    struct Shown;
    struct Borrowed {
        std::uint16_t to, from;  // range of a brick's texels
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

    // Guards the wish; held only while it is swapped.
    mutable std::mutex mWishMutex;
    Wish mWish;
    std::atomic<std::uint64_t> mVersion = 0;
    std::uint64_t mDoneVersion = 0;
    std::condition_variable_any mWake, mDone;

    // Guards the choice of the next brick among workers.
    std::mutex mPickMutex;
    Wish mNow;
    std::uint64_t mNowVersion = 0;
    std::vector<std::size_t> mCursor;  // by level: the next entry of the list
    int mBusy = 0;
    // Whether a brick was skipped because another worker was busy with it.
    bool mPassedOver = false;
    std::vector<std::unique_ptr<Brick>> mBricks;  // by number

    // Guards the light for transfer: held while the texels of a brick are multiplied with it, or after a
    // change the texels of all bricks.
    std::mutex mLightMutex;
    std::vector<glm::vec3> mLight;               // order^2 harmonics of the sky, linear RGB
    std::vector<std::unique_ptr<Shown>> mShown;  // by brick

    std::atomic<std::uint64_t> mChanges = 0, mTexelsLit = 0;
    std::vector<std::jthread> mThreads;  // last: they end first
};

}  // namespace stereonav
