#include "engine/light/bake/bake_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"
#include "engine/light/bake/brick_peers.h"
#include "engine/light/bake/brick_work.h"
#include "engine/peers/piece_dealer.h"

namespace stereonav {
namespace {

// Samples of the first pass where the end is not known: enough for an estimate of the error.
constexpr std::uint32_t kFirstPass = 16;
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
            const BakeKeeping& keeping, Peers* peers)
        : mSums(sums), mBricks(sums, source), mGoal(goal), mProgress(progress), mKeeping(keeping) {
        if (!peers || peers->alone()) return;
        mPeers = peers;
        mDealer.emplace(*peers);
    }

    BakeEnd run() {
        mError = mSums.error();
        for (std::size_t n = 0; n < mSums.bricks().size(); ++n) {
            count(mSums.estimates[n], 1);
            mOwnTexels += static_cast<double>(mSums.texelsOf(n));
        }
        tell(0);
        report(true);
        while (mEnd == BakeEnd::Reached) {
            const std::uint32_t next = nextTarget();
            if (next == 0) break;
            runPass(next);
            mError = mSums.error();
        }
        if (mEnd != BakeEnd::Cancelled) tell(1);
        return mEnd;
    }

private:
    // Samples that texels have after the next pass; 0 when there is none.
    std::uint32_t nextTarget() const {
        const std::uint32_t now = mSums.fewestSamples();
        const std::uint32_t most = mostSamples();
        if (mSums.bricks().empty() || now >= most) return 0;
        if (now > 0 && mGoal.error > 0 && mError <= mGoal.error) return 0;
        std::uint32_t next = mGoal.error > 0 || mGoal.minutes > 0 ? kFirstPass : kBakeBatch;
        while (next <= now) next = next < kBakeBatch ? kBakeBatch : 2 * next;
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
            for (std::size_t n = 0; n < mSums.bricks().size(); ++n)
                if (mSums.samples[n] < target) todo.push_back(n);
            if (todo.empty()) return;
            countWork(target);
            mPause = false;
            if (mDealer)
                shareBricks(todo, target);
            else
                parallelFor(static_cast<int>(todo.size()), [&](int n) {
                    if (mStop || mPause) return;
                    advance(todo[n], target);
                });
            keepIfDue();
            if (mStop) return;
        }
    }

    void advance(std::size_t brick, std::uint32_t target) {
        const BrickEstimate before = mSums.estimates[brick];
        mBricks.advance(brick, target, [this](double samples) {
            mDone += samples;
            check();
            return mStop.load();
        });
        noteEstimate(before, mSums.estimates[brick]);
    }

    // Bricks are made by any of the processes; this one has the sums of all.
    void shareBricks(const std::vector<std::size_t>& todo, std::uint32_t target) {
        const BrickRuns runs(todo, mPeers->count());
        PieceWork work;
        work.count = runs.count();
        work.order = [&](std::size_t n) { return orderOf(mSums, runs.at(n), target, secondsLeftOfGoal()); };
        work.make = [&](std::size_t n, std::span<const std::byte>) {
            const std::span<const std::size_t> bricks = runs.at(n);
            parallelFor(static_cast<int>(bricks.size()), [&](int k) {
                if (!mStop) advance(bricks[static_cast<std::size_t>(k)], target);
            });
            return PeerBytes{};
        };
        work.take = [&](std::size_t n, std::span<const std::byte> made) {
            if (!made.empty()) takeBricks(runs.at(n), made);
            keepIfDue();
        };
        work.ended = [this] {
            if (mPeers->failed()) end(BakeEnd::Cancelled);
            check();
            return mStop.load();
        };
        try {
            mDealer->deal(work);
        } catch (const Cancelled&) {
            end(BakeEnd::Cancelled);
        } catch (const PeerFailure&) {
            end(BakeEnd::Cancelled);
        }
    }

    // Takes bricks that another process made.
    void takeBricks(std::span<const std::size_t> bricks, std::span<const std::byte> made) {
        std::vector<BrickEstimate> estimates;
        double before = 0, after = 0;
        const auto samplesOf = [&](std::size_t brick) {
            return static_cast<double>(mSums.samples[brick]) * static_cast<double>(mSums.texelsOf(brick));
        };
        for (const std::size_t brick : bricks) {
            estimates.push_back(mSums.estimates[brick]);
            before += samplesOf(brick);
        }
        takeResult(mSums, bricks, made);
        for (std::size_t n = 0; n < bricks.size(); ++n) {
            noteEstimate(estimates[n], mSums.estimates[bricks[n]]);
            after += samplesOf(bricks[n]);
        }
        mDone += after - before;
    }

    double secondsLeftOfGoal() const {
        if (!(mGoal.minutes > 0)) return std::numeric_limits<double>::infinity();
        return std::max(0.0, 60 * mGoal.minutes - mSinceStart.elapsed_ms() / 1000);
    }

    bool keepingIsDue() const {
        return mKeeping.keep && !mStop && mSinceKept.elapsed_ms() > 1000 * mKeeping.everySeconds;
    }

    void keepIfDue() {
        if (!keepingIsDue()) return;
        mKeeping.keep(mSums);
        mSinceKept = Stopwatch();
    }

    void noteEstimate(const BrickEstimate& before, const BrickEstimate& now) {
        count(before, -1);
        count(now, 1);
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

    // Called after each batch, on any thread.
    void check() {
        if (mProgress.cancelled()) end(BakeEnd::Cancelled);
        if (mGoal.minutes > 0 && mSinceStart.elapsed_ms() >= 60000 * mGoal.minutes) end(BakeEnd::TimeUp);
        if (keepingIsDue()) mPause = true;
        report(false);
    }

    void report(bool now) {
        double due = mNextReport_ms;
        const double time = mSinceStart.elapsed_ms();
        if (!now && (time < due || !mNextReport_ms.compare_exchange_strong(due, time + kReport_ms))) return;
        tell(fraction());
    }

    // Reports never less than before, though more work may turn up than was foreseen.
    void tell(double fraction) {
        const std::lock_guard lock(mTelling);
        mTold = std::max(mTold, fraction);
        try {
            mProgress.report(mTold, text());
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
        for (std::size_t n = 0; n < mSums.bricks().size(); ++n)
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
    const BrickWork mBricks;
    const BakeGoal mGoal;
    Progress& mProgress;
    const BakeKeeping& mKeeping;
    Peers* mPeers = nullptr;             // several processes, this being the first
    std::optional<PieceDealer> mDealer;  // deals pieces among the processes
    const Stopwatch mSinceStart;
    Stopwatch mSinceKept;
    std::atomic<bool> mStop = false, mPause = false;
    std::atomic<BakeEnd> mEnd = BakeEnd::Reached;
    std::atomic<double> mError = 0, mDone = 0, mNextReport_ms = 0;
    std::atomic<double> mVariance = 0, mSquare = 0;
    std::mutex mTelling;
    double mTold = 0;  // guarded by mTelling
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

BakeEnd runBake(BakeSums& sums, const BakeSource& source, const BakeGoal& goal, Progress& progress,
                const BakeKeeping& keeping, Peers* peers) {
    return BakeRun(sums, source, goal, progress, keeping, peers).run();
}

void serveBake(BakeSums& sums, const BakeSource& source, Peers& peers) {
    const BrickWork work(sums, source);
    peers.serve([&](std::size_t, std::span<const std::byte> order) {
        if (stopWished()) throw Cancelled();
        return resultOf(sums, work, order);
    });
}

}  // namespace stereonav
