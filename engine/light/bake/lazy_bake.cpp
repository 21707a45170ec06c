// Levels: one texel of every 4^3, one of every 2^3, all texels, and then more samples for all; each level of
// all bricks comes before the next level of any. A texel that is not lit yet borrows the light of the one
// that was lit for its block, with a weight so small that lit neighbours dominate.
#include "engine/light/bake/lazy_bake.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"
#include "engine/light/bake/brick_work.h"

namespace stereonav {
namespace {

constexpr int kTexels = 512;
constexpr int kAllLevel = 2;  // the first of all texels
// Texels per call: with 64 samples some milliseconds of work, after which new wishes are looked for.
constexpr std::size_t kAtOnce = 64;
constexpr float kBorrowed[] = {1.0f / 64, 1.0f / 8};         // weights by level
constexpr float kGiven = std::numeric_limits<float>::max();  // "samples" of texels that were lit elsewhere
constexpr int kOnNoSurface = 1000;                           // larger than every other rank
constexpr int kNiceness = 15;

void lowerPriority() {
    // Sets the priority of this thread only. Where that is refused, the thread keeps the usual one.
    setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNiceness);
}

bool isIn(const TexelMask& mask, int texel) {
    return mask[texel >> 6] >> (texel & 63) & 1;
}

glm::ivec3 inBrick(int texel) {
    return {texel & 7, texel >> 3 & 7, texel >> 6};
}

// Returns the number of a texel's block of 4^3 (level 0) or 2^3 (level 1), and its distance from the block's
// middle.
int blockOf(int texel, int level) {
    const int shift = 2 - level, side = 8 >> shift;
    const glm::ivec3 b = inBrick(texel) >> shift;
    return (b.z * side + b.y) * side + b.x;
}
int fromMiddle(int texel, int level) {
    const int size = 4 >> level;
    const glm::ivec3 away = 2 * (inBrick(texel) & (size - 1)) - (size - 1);
    return away.x * away.x + away.y * away.y + away.z * away.z;
}

}  // namespace

struct LazyBake::Brick {
    std::uint32_t number = 0;
    glm::ivec3 first{0};
    // Guarded by the pick mutex.
    int level = 0;
    std::uint64_t choice = 0;  // the choice that `level` refers to; 0: none
    bool busy = false;
    // The following members belong to the thread that has set `busy`.
    std::uint64_t chosen = 0;  // the choice that `wanted` was made for
    TexelMask wanted{}, held{};
    std::vector<TexelSum> sums;  // sums of held texels; for transfer only how many samples
    int each = 0;                // numbers of a texel's transfer
    std::vector<float> numbers;  // sums of samples of held texels

    std::size_t slot(int texel) const {
        std::size_t before = 0;
        for (int k = 0; k < texel >> 6; ++k) before += static_cast<std::size_t>(std::popcount(held[k]));
        return before +
               static_cast<std::size_t>(std::popcount(held[texel >> 6] & ((1ull << (texel & 63)) - 1)));
    }
    void hold(const TexelMask& more) {
        std::vector<TexelSum> all;
        std::vector<float> allNumbers;
        std::size_t from = 0;
        for (int t = 0; t < kTexels; ++t) {
            if (isIn(held, t)) {
                const auto own = numbers.begin() + static_cast<std::ptrdiff_t>(from) * each;
                allNumbers.insert(allNumbers.end(), own, own + each);
                all.push_back(sums[from++]);
            } else if (isIn(more, t)) {
                allNumbers.resize(allNumbers.size() + static_cast<std::size_t>(each));
                all.emplace_back();
            }
        }
        for (int k = 0; k < 8; ++k) held[k] |= more[k];
        sums = std::move(all);
        numbers = std::move(allNumbers);
    }
};

// Data of a brick for changes of the light, under the light's mutex.
struct LazyBake::Shown {
    TransferVolume transfer;  // transfer of this brick alone
    std::vector<Borrowed> borrowed;
};

LazyBake::LazyBake(const GreyVolume& volume, const TexelChoice& choice, BakeSource source,
                   IlluminationVolume& to, const LazyBakeSetting& setting)
    : mVolume(volume), mSource(std::move(source)), mTo(to), mSetting(setting) {
    const glm::ivec3 bricks = to.layout.bricks;
    mBricks.resize(static_cast<std::size_t>(bricks.x) * bricks.y * bricks.z);
    mWish = {std::make_shared<std::vector<std::uint32_t>>(),
             std::make_shared<TexelChooser>(volume, to.frame, choice), 1};
    mNow = mWish;
    mCursor.assign(static_cast<std::size_t>(levels()), 0);
    if (transfers()) mShown.resize(mBricks.size());
    for (int n = 0; n < std::max(1, setting.threads); ++n)
        mThreads.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

LazyBake::~LazyBake() {
    for (std::jthread& thread : mThreads) thread.request_stop();
}

int LazyBake::levels() const {
    int count = kAllLevel + 1;
    while (samplesAt(count - 1) < static_cast<std::uint32_t>(std::max(mSetting.refineTo, mSetting.samples)))
        ++count;
    return count;
}

std::uint32_t LazyBake::samplesAt(int level) const {
    const std::uint32_t base = static_cast<std::uint32_t>(std::clamp(mSetting.samples, 1, 1 << 24));
    if (level <= kAllLevel) return base;
    const std::uint64_t doubled = static_cast<std::uint64_t>(base) << std::min(level - kAllLevel, 24);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(
        doubled, static_cast<std::uint64_t>(std::clamp(mSetting.refineTo, 1, 1 << 24))));
}

void LazyBake::request(std::vector<std::uint32_t> bricks) {
    change(std::make_shared<const std::vector<std::uint32_t>>(std::move(bricks)), nullptr);
}

void LazyBake::setChoice(const TexelChoice& choice) {
    change(nullptr, std::make_shared<const TexelChooser>(mVolume, mTo.frame, choice));
}

// Changes the parts of the wish that are given; null leaves a part as it is.
void LazyBake::change(const std::shared_ptr<const std::vector<std::uint32_t>>& bricks,
                      const std::shared_ptr<const TexelChooser>& chooser) {
    std::shared_ptr<const std::vector<std::uint32_t>> before;  // freed after the mutex
    {
        const std::lock_guard lock(mWishMutex);
        if (bricks && *mWish.bricks == *bricks) return;
        before = mWish.bricks;
        if (bricks) mWish.bricks = bricks;
        if (chooser) {
            mWish.chooser = chooser;
            ++mWish.choice;
        }
        ++mVersion;
    }
    mWake.notify_all();
}

bool LazyBake::done() const {
    const std::lock_guard lock(mWishMutex);
    return mDoneVersion == mVersion;
}

bool LazyBake::waitUntilDone(double seconds) {
    std::unique_lock lock(mWishMutex);
    return mDone.wait_for(lock, std::chrono::duration<double>(seconds),
                          [this] { return mDoneVersion == mVersion; });
}

void LazyBake::work(const std::stop_token& stop) {
    lowerPriority();
    while (!stop.stop_requested()) {
        Task task;
        const Pick found = pick(task);
        if (found == Pick::Found)
            giveBack(task, light(task, stop));
        else
            wait(found, task.version, stop);
    }
}

// Waits until there is another wish, or, where other threads are busy with bricks, a short time until they
// may be free.
void LazyBake::wait(Pick found, std::uint64_t seen, const std::stop_token& stop) {
    std::unique_lock lock(mWishMutex);
    if (mVersion != seen) return;
    const auto another = [&] { return mVersion != seen; };
    if (found == Pick::OthersAreBusy) {
        constexpr std::chrono::milliseconds kOthersWork(5);
        mWake.wait_for(lock, stop, kOthersWork, another);
        return;
    }
    mDoneVersion = seen;
    mDone.notify_all();
    mWake.wait(lock, stop, another);
}

void LazyBake::takeWish() {
    const std::lock_guard lock(mWishMutex);
    mNow = mWish;
    mNowVersion = mVersion;
}

LazyBake::Brick& LazyBake::brickAt(std::uint32_t number) {
    std::unique_ptr<Brick>& brick = mBricks[number];
    if (!brick) {
        brick = std::make_unique<Brick>();
        brick->number = number;
        brick->first = brickPlace(mTo.layout, number) * 8;
        brick->each = mSetting.shape.numbersPerTexel();
    }
    return *brick;
}

LazyBake::Pick LazyBake::pick(Task& task) {
    const std::lock_guard lock(mPickMutex);
    if (mVersion != mNowVersion) {
        takeWish();
        std::fill(mCursor.begin(), mCursor.end(), 0);
        mPassedOver = false;
    }
    task.version = mNowVersion;
    for (;;) {
        for (int level = 0; level < static_cast<int>(mCursor.size()); ++level)
            if (pickAtLevel(level, task)) return Pick::Found;
        if (mBusy > 0) return Pick::OthersAreBusy;
        if (!mPassedOver) return Pick::NothingLeft;
        std::fill(mCursor.begin(), mCursor.end(), 0);
        mPassedOver = false;
    }
}

bool LazyBake::pickAtLevel(int level, Task& task) {
    const std::vector<std::uint32_t>& list = *mNow.bricks;
    std::size_t& at = mCursor[static_cast<std::size_t>(level)];
    for (; at < list.size(); ++at) {
        if (list[at] >= mBricks.size()) continue;
        Brick& brick = brickAt(list[at]);
        const int reached = brick.choice == mNow.choice ? brick.level : 0;
        if (brick.busy || reached < level) mPassedOver = true;
        if (brick.busy || reached != level) continue;
        ++at;
        brick.busy = true;
        brick.level = level;
        brick.choice = mNow.choice;
        ++mBusy;
        task = {&brick, level, mNowVersion, mNow.chooser};
        return true;
    }
    return false;
}

void LazyBake::giveBack(const Task& task, bool finished) {
    const std::lock_guard lock(mPickMutex);
    Brick& brick = *task.brick;
    brick.busy = false;
    --mBusy;
    if (!finished) return;
    // A brick without texels to light has nothing to do at the next levels either.
    brick.level = countTexels(brick.wanted) == 0 ? std::numeric_limits<int>::max() : task.level + 1;
}

// Chooses the wanted texels; those that were lit elsewhere count as done.
void LazyBake::choose(const Task& task) {
    Brick& brick = *task.brick;
    brick.wanted = task.chooser->brick(brick.number);
    brick.chosen = brick.choice;
    brick.hold(brick.wanted);
    for (int t = 0; t < kTexels; ++t) {
        if (!isIn(brick.wanted, t)) continue;
        TexelSum& sum = brick.sums[brick.slot(t)];
        if (sum.samples == 0 && texelWeight(load(brick.number, t)) >= 1) sum.samples = kGiven;
    }
}

std::vector<int> LazyBake::texelsAt(const Brick& brick, int level) const {
    std::vector<int> texels;
    if (level >= kAllLevel) {
        for (int t = 0; t < kTexels; ++t)
            if (isIn(brick.wanted, t)) texels.push_back(t);
        return texels;
    }
    // For each block the texel nearest to its middle; none where one is lit already.
    int best[64];
    std::fill(std::begin(best), std::end(best), -1);
    for (int t = 0; t < kTexels; ++t) {
        if (!isIn(brick.wanted, t)) continue;
        int& b = best[blockOf(t, level)];
        const auto rank = [&](int texel) {
            const float samples = brick.sums[brick.slot(texel)].samples;
            return samples > 0 ? -1 : samples < 0 ? kOnNoSurface : fromMiddle(texel, level);
        };
        if (b < 0 || rank(t) < rank(b)) b = t;
    }
    for (const int t : best)
        if (t >= 0) texels.push_back(t);
    return texels;
}

bool LazyBake::light(const Task& task, const std::stop_token& stop) {
    Brick& brick = *task.brick;
    if (brick.chosen != brick.choice) choose(task);
    const std::vector<int> texels = texelsAt(brick, task.level);
    for (std::size_t from = 0; from < texels.size(); from += kAtOnce) {
        const auto begin = texels.begin() + static_cast<std::ptrdiff_t>(from);
        const std::vector<int> some(
            begin, begin + static_cast<std::ptrdiff_t>(std::min(kAtOnce, texels.size() - from)));
        if (!lightTexels(task, some, stop)) return false;
    }
    if (transfers()) {
        publishTransfer(brick, task.level);
    } else if (task.level < kAllLevel) {
        for (const Borrowed& b : borrowers(brick, task.level))
            store(brick.number, b.to, packTexel(texelLight(load(brick.number, b.from)), b.weight));
    }
    if (!texels.empty()) ++mChanges;
    return true;
}

// Lights texels in the bake's batches, so that the same samples give the same bytes. Returns false where
// another wish interrupts it.
bool LazyBake::lightTexels(const Task& task, const std::vector<int>& texels, const std::stop_token& stop) {
    Brick& brick = *task.brick;
    const std::uint32_t target = samplesAt(task.level);
    for (;;) {
        float least = kGiven;
        for (const int t : texels) {
            const float samples = brick.sums[brick.slot(t)].samples;
            if (samples >= 0) least = std::min(least, samples);
        }
        if (least >= static_cast<float>(target)) break;
        if (stop.stop_requested() || mVersion != task.version) return false;
        std::vector<int> some;
        for (const int t : texels)
            if (brick.sums[brick.slot(t)].samples == least) some.push_back(t);
        const auto now = static_cast<std::uint32_t>(least);
        const std::uint32_t end = endOfBatch(now, target);
        transfers() ? addTransfer(brick, some, now, end) : addSamples(brick, some, now, end);
    }
    if (!transfers()) publish(brick, texels);
    return true;
}

// Batches end where those of runBake do.
std::uint32_t LazyBake::endOfBatch(std::uint32_t first, std::uint32_t target) const {
    const std::uint32_t end = std::min(batchEnd(first), target);
    return transfers() && first == 0 ? (end + 1) / 2 : end;
}

void LazyBake::addSamples(Brick& brick, const std::vector<int>& texels, std::uint32_t first,
                          std::uint32_t end) {
    std::vector<glm::ivec3> places;
    std::vector<TexelSum> sums;
    for (const int t : texels) {
        places.push_back(brick.first + inBrick(t));
        sums.push_back(brick.sums[brick.slot(t)]);
    }
    mSource.addIrradiance(places, static_cast<int>(end - first), sums);
    for (std::size_t n = 0; n < texels.size(); ++n) brick.sums[brick.slot(texels[n])] = sums[n];
}

void LazyBake::addTransfer(Brick& brick, const std::vector<int>& texels, std::uint32_t first,
                           std::uint32_t end) {
    const auto numbersOf = [&](int texel) {
        return brick.numbers.begin() + static_cast<std::ptrdiff_t>(brick.slot(texel)) * brick.each;
    };
    std::vector<glm::ivec3> places;
    std::vector<float> numbers;
    for (const int t : texels) {
        places.push_back(brick.first + inBrick(t));
        numbers.insert(numbers.end(), numbersOf(t), numbersOf(t) + brick.each);
    }
    std::vector<std::uint8_t> alive(texels.size(), 1);
    mSource.addTransfer(places, static_cast<int>(first), static_cast<int>(end - first), mSetting.shape.order,
                        mSetting.shape.channels, numbers, alive);
    for (std::size_t n = 0; n < texels.size(); ++n) {
        brick.sums[brick.slot(texels[n])].samples = alive[n] ? static_cast<float>(end) : -1.0f;
        std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(n) * brick.each, brick.each,
                    numbersOf(texels[n]));
    }
}

void LazyBake::publish(Brick& brick, const std::vector<int>& texels) {
    for (const int t : texels) {
        const TexelSum& sum = brick.sums[brick.slot(t)];
        if (sum.samples == kGiven) continue;
        if (texelWeight(load(brick.number, t)) < 1 && sum.samples > 0) ++mTexelsLit;
        store(brick.number, t, sum.samples > 0 ? packTexel(sum.mean, 1) : 0);
    }
    ++mChanges;
}

// Returns all of the brick's texels again, as half floats and in the order that a bake's volume has: the same
// bytes.
std::unique_ptr<LazyBake::Shown> LazyBake::shownOf(const Brick& brick) const {
    TexelBrick known{brick.number, {}};
    std::vector<float> means;
    for (int t = 0; t < kTexels; ++t) {
        if (!isIn(brick.held, t)) continue;
        const std::size_t slot = brick.slot(t);
        const float samples = brick.sums[slot].samples;
        if (!(samples > 0) || samples == kGiven) continue;
        known.wanted[t >> 6] |= 1ull << (t & 63);
        const float share = 1.0f / samples;
        const auto first = brick.numbers.begin() + static_cast<std::ptrdiff_t>(slot) * brick.each;
        for (auto n = first; n != first + brick.each; ++n) means.push_back(*n * share);
    }
    auto shown = std::make_unique<Shown>();
    shown->transfer = TransferVolume(mTo.frame, mSetting.shape.order, mSetting.shape.channels, {known});
    shown->transfer.setBrick(0, means);
    return shown;
}

void LazyBake::publishTransfer(Brick& brick, int level) {
    std::unique_ptr<Shown> shown = shownOf(brick);
    const TexelMask known = shown->transfer.bricks()[0].wanted;
    const std::lock_guard lock(mLightMutex);
    for (int t = 0; t < kTexels; ++t) {
        if (isIn(known, t)) mTexelsLit += texelWeight(load(brick.number, t)) < 1;
        if (isIn(brick.wanted, t) && brick.sums[brick.slot(t)].samples < 0) store(brick.number, t, 0);
    }
    show(*shown);
    if (level < kAllLevel) {
        shown->borrowed = borrowers(brick, level);
        show(*shown);
    }
    mShown[brick.number] = std::move(shown);
}

// Called under the light's mutex.
void LazyBake::show(const Shown& shown) {
    shown.transfer.relightAll(mLight, mTo);
    const std::uint32_t number = shown.transfer.bricks()[0].number;
    for (const Borrowed& b : shown.borrowed)
        store(number, b.to, packTexel(texelLight(load(number, b.from)), b.weight));
}

void LazyBake::setLight(std::vector<glm::vec3> light) {
    const std::lock_guard lock(mLightMutex);
    mLight = std::move(light);
    std::vector<const Shown*> all;
    for (const std::unique_ptr<Shown>& shown : mShown)
        if (shown) all.push_back(shown.get());
    constexpr int kAtATime = 16;
    const int count = static_cast<int>(all.size());
    parallelFor((count + kAtATime - 1) / kAtATime, [&](int part) {
        for (int n = part * kAtATime; n < std::min((part + 1) * kAtATime, count); ++n) show(*all[n]);
    });
}

std::vector<LazyBake::Borrowed> LazyBake::borrowers(const Brick& brick, int level) const {
    int lit[64];
    std::fill(std::begin(lit), std::end(lit), -1);
    for (int t = 0; t < kTexels; ++t)
        if (isIn(brick.wanted, t) && texelWeight(load(brick.number, t)) >= 1) {
            int& l = lit[blockOf(t, level)];
            if (l < 0 || fromMiddle(t, level) < fromMiddle(l, level)) l = t;
        }
    std::vector<Borrowed> borrowed;
    for (int t = 0; t < kTexels; ++t) {
        const int from = lit[blockOf(t, level)];
        if (from < 0 || !isIn(brick.wanted, t) || texelWeight(load(brick.number, t)) >= 1) continue;
        if (brick.sums[brick.slot(t)].samples < 0) continue;
        borrowed.push_back(
            {static_cast<std::uint16_t>(t), static_cast<std::uint16_t>(from), kBorrowed[level]});
    }
    return borrowed;
}

PackedTexel LazyBake::load(std::uint32_t brick, int texel) const {
    PackedTexel& word = mTo.texels[static_cast<std::size_t>(brick) * kTexels + texel];
    return std::atomic_ref<PackedTexel>(word).load(std::memory_order_relaxed);
}

void LazyBake::store(std::uint32_t brick, int texel, PackedTexel value) {
    PackedTexel& word = mTo.texels[static_cast<std::size_t>(brick) * kTexels + texel];
    std::atomic_ref<PackedTexel>(word).store(value, std::memory_order_relaxed);
}

}  // namespace stereonav
