#include "engine/light/bake/bake_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

// Samples of the first pass where the end is not known: enough for an estimate of the error.
constexpr std::uint32_t kFirstPass = 16;
// Samples at once. TexelLighter gave 0.5, 0.9 and 1.2 million samples a second for 16, 64 and 128 at once
// (160 texels of the engine under Grace, one thread of a busy machine).
constexpr std::uint32_t kBatch = 128;
// Floats count samples exactly up to here.
constexpr std::uint32_t kMostSamples = 1u << 24;
constexpr double kReport_ms = 50;

std::string timeText(double seconds) {
    if (!(seconds < 1e7)) return "long";
    const auto s = static_cast<long long>(std::ceil(seconds));
    return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                    : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string errorText(double error) {
    return std::isfinite(error) ? fmt::format("error {:.2g} %", 100 * error) : "error not known yet";
}

class BakeRun {
public:
    BakeRun(BakeSums& sums, const BakeSource& source, const BakeGoal& goal, Progress& progress,
            const BakeKeeping& keeping, const BakeShare& share)
        : mSums(sums), mSource(source), mGoal(goal), mProgress(progress), mKeeping(keeping), mShare(share) {}

    BakeEnd run() {
        mError = mSums.error();
        for (std::size_t n = mShare.index; n < mSums.bricks().size(); n += mShare.count) {
            count(mSums.estimates[n], 1);
            mOwnTexels += static_cast<double>(mSums.texelsOf(n));
        }
        report(true);
        while (mEnd == BakeEnd::Reached) {
            const std::uint32_t next = nextTarget();
            if (next == 0) break;
            runPass(next);
            if (mShare.meet) mEnd = mShare.meet(mSums, mEnd);
            mError = mSums.error();
        }
        return mEnd;
    }

private:
    // Samples that texels have after the next pass; 0 when there is none.
    std::uint32_t nextTarget() const {
        const std::uint32_t now = mSums.fewestSamples();
        const std::uint32_t most = mostSamples();
        if (mSums.bricks().empty() || now >= most) return 0;
        if (now > 0 && mGoal.error > 0 && mError <= mGoal.error) return 0;
        std::uint32_t next = mGoal.error > 0 || mGoal.minutes > 0 ? kFirstPass : kBatch;
        while (next <= now) next = next < kBatch ? kBatch : 2 * next;
        return std::min({next, most, mGoal.error > 0 ? neededForError(now) : most});
    }

    std::uint32_t mostSamples() const {
        return mGoal.samples > 0 ? std::min(static_cast<std::uint32_t>(mGoal.samples), kMostSamples)
                                 : kMostSamples;
    }

    // The error falls at least with the root of the samples; a little more, since the estimate has its own.
    std::uint32_t neededForError(std::uint32_t now) const {
        const double ratio = mError.load() / mGoal.error;
        const double needed = std::ceil(1.05 * now * ratio * ratio / kFirstPass) * kFirstPass;
        if (now == 0 || !(needed < kMostSamples)) return kMostSamples;
        return std::max(static_cast<std::uint32_t>(needed), (now / kFirstPass + 1) * kFirstPass);
    }

    void runPass(std::uint32_t target) {
        for (;;) {
            std::vector<std::size_t> todo;
            for (std::size_t n = mShare.index; n < mSums.bricks().size(); n += mShare.count)
                if (mSums.samples[n] < target) todo.push_back(n);
            if (todo.empty()) return;
            countWork(target);
            mPause = false;
            parallelFor(static_cast<int>(todo.size()), [&](int n) {
                if (mStop || mPause) return;
                advance(todo[n], target);
            });
            if (mKeeping.keep && !mStop && mSinceKept.elapsed_ms() > 1000 * mKeeping.everySeconds) {
                mKeeping.keep(mSums);
                mSinceKept = Stopwatch();
            }
            if (mStop) return;
        }
    }

    void advance(std::size_t brick, std::uint32_t target) {
        const bool transfer = mSums.shape().kind == BakeKind::Transfer;
        std::uint32_t countBefore = mSums.samples[brick];
        std::vector<float> before;
        const auto remember = [&] {
            countBefore = mSums.samples[brick];
            if (transfer) before.assign(mSums.transfer(brick).begin(), mSums.transfer(brick).end());
        };
        remember();
        while (mSums.samples[brick] < target && !mStop) {
            const std::uint32_t now = mSums.samples[brick];
            std::uint32_t end = std::min(batchEnd(now), target);
            // Two parts tell how much they differ.
            if (transfer && now == 0) end = (end + 1) / 2;

            transfer ? addTransfer(brick, now, end - now) : addIrradiance(brick, end - now);
            mSums.samples[brick] = end;
            if (now == 0 && end < target) remember();  // so that the first pass tells its error, too
            mDone += static_cast<double>((end - now) * mSums.texelsOf(brick));
            check();
        }
        if (mSums.samples[brick] < target && transfer) return;
        count(mSums.estimates[brick], -1);
        mSums.estimates[brick] =
            transfer ? estimateOf(before, countBefore, mSums.transfer(brick), mSums.samples[brick])
                     : estimateOf(mSums.light(brick));
        count(mSums.estimates[brick], 1);
    }

    // Texels on no surface are left out: they are known after the first batch.
    void addIrradiance(std::size_t brick, std::uint32_t count) {
        const std::vector<glm::ivec3> all = texelsIn(mSums.layout(), mSums.bricks()[brick]);
        const std::span<TexelSum> sums = mSums.light(brick);
        std::vector<glm::ivec3> texels;
        std::vector<TexelSum> some;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (sums[n].samples < 0) continue;
            texels.push_back(all[n]);
            some.push_back(sums[n]);
        }
        if (texels.empty()) return;
        mSource.addIrradiance(texels, static_cast<int>(count), some);
        std::size_t from = 0;
        for (TexelSum& sum : sums)
            if (!(sum.samples < 0)) sum = some[from++];
    }

    void addTransfer(std::size_t brick, std::uint32_t first, std::uint32_t count) {
        const std::vector<glm::ivec3> all = texelsIn(mSums.layout(), mSums.bricks()[brick]);
        const std::span<float> sums = mSums.transfer(brick);
        const std::span<std::uint8_t> alive = mSums.alive(brick);
        const auto each = static_cast<std::ptrdiff_t>(mSums.shape().numbersPerTexel());
        std::vector<glm::ivec3> texels;
        std::vector<float> some;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (!alive[n]) continue;
            texels.push_back(all[n]);
            const auto from = sums.begin() + static_cast<std::ptrdiff_t>(n) * each;
            some.insert(some.end(), from, from + each);
        }
        if (texels.empty()) return;
        std::vector<std::uint8_t> someAlive(texels.size(), 1);
        mSource.addTransfer(texels, static_cast<int>(first), static_cast<int>(count), mSums.shape().order,
                            mSums.shape().channels, some, someAlive);
        std::ptrdiff_t from = 0;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (!alive[n]) continue;
            alive[n] = someAlive[static_cast<std::size_t>(from)];
            std::copy_n(some.begin() + from * each, each,
                        sums.begin() + static_cast<std::ptrdiff_t>(n) * each);
            ++from;
        }
    }

    // For what is told on the way: the error of the bricks where it is known.
    void count(const BrickEstimate& estimate, int sign) {
        if (!std::isfinite(estimate.variance)) return;
        mVariance += sign * estimate.variance;
        mSquare += sign * estimate.square;
    }
    double presentError() const {
        const double variance = std::max(mVariance.load(), 0.0), square = mSquare;
        return square > 0 ? std::sqrt(variance / square) : mError.load();
    }

    // After each batch, on any thread.
    void check() {
        if (mProgress.cancelled()) end(BakeEnd::Cancelled);
        if (mGoal.minutes > 0 && mSinceStart.elapsed_ms() >= 60000 * mGoal.minutes) end(BakeEnd::TimeUp);
        if (mKeeping.keep && mSinceKept.elapsed_ms() > 1000 * mKeeping.everySeconds) mPause = true;
        report(false);
    }

    void report(bool now) {
        double due = mNextReport_ms;
        const double time = mSinceStart.elapsed_ms();
        if (!now && (time < due || !mNextReport_ms.compare_exchange_strong(due, time + kReport_ms))) return;
        try {
            mProgress.report(fraction(), text());
        } catch (const Cancelled&) {
            end(BakeEnd::Cancelled);
        }
    }

    void end(BakeEnd how) {
        bool expected = false;
        if (mStop.compare_exchange_strong(expected, true)) mEnd = how;
    }

    // Texel samples of the whole bake as far as it can be foreseen, and those of them that are done.
    void countWork(std::uint32_t target) {
        const std::uint32_t fewest = mSums.fewestSamples();
        double last = mGoal.samples > 0 ? mGoal.samples : target;
        if (mGoal.error > 0 && fewest > 0 && std::isfinite(mError.load())) {
            const double foreseen = std::max(target, neededForError(fewest));
            last = mGoal.samples > 0 ? std::min(last, foreseen) : foreseen;
        }
        double done = 0;
        for (std::size_t n = mShare.index; n < mSums.bricks().size(); n += mShare.count)
            done += static_cast<double>(mSums.samples[n]) * static_cast<double>(mSums.texelsOf(n));
        mAll = last * mOwnTexels;
        mDone = done;
        if (!mCounted) mDoneBefore = done;
        mCounted = true;
    }

    double fraction() const {
        const double work = mAll > 0 ? mDone / mAll : 0;
        const double time = mGoal.minutes > 0 ? mSinceStart.elapsed_ms() / (60000 * mGoal.minutes) : 0;
        return std::clamp(mGoal.samples == 0 && mGoal.error == 0 ? time : std::max(work, time), 0.0, 1.0);
    }

    double secondsLeft() const {
        const double elapsed = mSinceStart.elapsed_ms() / 1000, done = mDone - mDoneBefore;
        double left = done > 0 ? (mAll - mDone) * elapsed / done : std::numeric_limits<double>::infinity();
        if (mGoal.minutes > 0) {
            const double time = std::max(60 * mGoal.minutes - elapsed, 0.0);
            left = mGoal.samples == 0 && mGoal.error == 0 ? time : std::min(left, time);
        }
        return left;
    }

    std::string text() const {
        const double each = mDone / std::max(1.0, mOwnTexels);
        const double left = secondsLeft();
        return fmt::format("{}: {:.0f} samples a texel, {}{}", nameOf(mSums.shape().kind), each,
                           errorText(presentError()),
                           std::isfinite(left) ? ", " + timeText(left) + " left" : "");
    }

    BakeSums& mSums;
    const BakeSource& mSource;
    const BakeGoal mGoal;
    Progress& mProgress;
    const BakeKeeping& mKeeping;
    const BakeShare& mShare;
    const Stopwatch mSinceStart;
    Stopwatch mSinceKept;
    std::atomic<bool> mStop = false, mPause = false;
    std::atomic<BakeEnd> mEnd = BakeEnd::Reached;
    std::atomic<double> mError = 0, mDone = 0, mNextReport_ms = 0;
    std::atomic<double> mVariance = 0, mSquare = 0;
    double mOwnTexels = 0;
    double mAll = 0, mDoneBefore = 0;
    bool mCounted = false;
};

}  // namespace

BakeSource sourceOf(const TexelLighter& lighter) {
    BakeSource source;
    source.addIrradiance = [&lighter](std::span<const glm::ivec3> texels, int count,
                                      std::span<TexelSum> sums) {
        lighter.addIrradiance(texels, count, sums);
    };
    source.addTransfer = [&lighter](std::span<const glm::ivec3> texels, int first, int count, int order,
                                    int channels, std::span<float> sums, std::span<std::uint8_t> alive) {
        lighter.addTransfer(texels, first, count, order, channels, sums, alive);
    };
    return source;
}

std::uint32_t batchEnd(std::uint32_t first) {
    return (first / kBatch + 1) * kBatch;
}

BakeEnd runBake(BakeSums& sums, const BakeSource& source, const BakeGoal& goal, Progress& progress,
                const BakeKeeping& keeping, const BakeShare& share) {
    return BakeRun(sums, source, goal, progress, keeping, share).run();
}

}  // namespace stereonav
