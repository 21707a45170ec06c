// One piece of work at a time on a thread of its own, beside the window's thread. There is no thread before
// start().
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/progress.h"

namespace stereonav {

template <typename Result>
class BesideWork {
public:
    using Work = std::function<Result(Progress&)>;

    BesideWork() = default;
    BesideWork(const BesideWork&) = delete;
    BesideWork& operator=(const BesideWork&) = delete;
    ~BesideWork() { cancel(); }  // waits for the end

    bool busy() const { return mWork.valid(); }
    double fraction() const { return mFraction; }
    // Cancels the work: take() then throws Cancelled soon, even where the work finishes or fails.
    void cancel() {
        if (mProgress) mProgress->cancel();
    }
    // Starts work; not allowed while busy. wake: called from the other thread when it is done.
    void start(Work work, std::function<void()> wake) {
        mFraction = 0;
        mProgress = std::make_unique<Progress>(
            [this](double fraction, const std::string&) { mFraction = std::clamp(fraction, 0.0, 1.0); });
        mWork = std::async(std::launch::async,
                           [&progress = *mProgress, work = std::move(work), wake = std::move(wake)] {
                               struct Wake {
                                   const std::function<void()>& call;
                                   ~Wake() { call(); }
                               } const atEnd{wake};
                               return work(progress);
                           });
    }
    // Returns the result; empty while it is not done, or nothing was started. Throws the work's exceptions.
    std::optional<Result> take() {
        if (!busy() || mWork.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return std::nullopt;
        const bool cancelled = mProgress->cancelled();
        try {
            Result result = mWork.get();
            if (!cancelled) return result;
        } catch (const std::exception&) {
            if (!cancelled) throw;
        }
        throw Cancelled();
    }

private:
    std::atomic<double> mFraction = 0;
    std::unique_ptr<Progress> mProgress;  // progress of the present work
    std::future<Result> mWork;            // last member: its end is waited for first
};

}  // namespace stereonav
