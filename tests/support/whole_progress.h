// Check for every function of the program that takes a Progress: it reports 0 first, never less than before,
// and 1 last.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/progress.h"

namespace stereonav::test {

// Records reports in their order.
class WrittenProgress {
public:
    Progress& progress() { return mProgress; }
    // Returns the reports so far; the work may go on.
    std::vector<double> told() const {
        const std::lock_guard lock(mMutex);
        return mTold;
    }

    // steps: number of shares between 0 and 1 that have to be among them.
    void expectWhole(const std::string& of, std::size_t steps = 0) const {
        const std::vector<double> all = told();
        ASSERT_FALSE(all.empty()) << of << " tells nothing";
        EXPECT_EQ(all.front(), 0) << of << " does not begin with 0";
        EXPECT_EQ(all.back(), 1) << of << " does not end with 1";
        std::size_t between = 0;
        for (std::size_t n = 1; n < all.size(); ++n) {
            ASSERT_GE(all[n], all[n - 1]) << of << " goes back";
            between += all[n] > all[n - 1] && all[n] < 1;
        }
        EXPECT_GE(between, steps) << of << " tells too little on the way";
    }

    // joints: shares where one stage ends and the next begins: each is reported by both, one after the other.
    void expectStages(const std::string& of, const std::vector<double>& joints) const {
        const std::vector<double> all = told();
        for (const double joint : joints) {
            const auto isJoint = [joint](double share) { return std::abs(share - joint) < 1e-9; };
            bool joined = false;
            for (std::size_t n = 1; n < all.size(); ++n)
                joined = joined || (isJoint(all[n - 1]) && isJoint(all[n]));
            EXPECT_TRUE(joined) << of << ": no stage ends at " << joint << " where the next begins";
        }
    }

private:
    mutable std::mutex mMutex;
    std::vector<double> mTold;  // guarded by mMutex
    Progress mProgress{[this](double fraction, const std::string&) {
        const std::lock_guard lock(mMutex);
        mTold.push_back(fraction);
    }};
};

// Runs work(progress) once as a whole; a second time it is stopped at its first report. joints: see
// expectStages().
template <typename Work>
void expectWholeProgress(const std::string& of, std::size_t steps, const Work& work,
                         const std::vector<double>& joints = {}) {
    WrittenProgress written;
    work(written.progress());
    written.expectWhole(of, steps);
    written.expectStages(of, joints);
    Progress* itself = nullptr;
    Progress stopping([&](double, const std::string&) { itself->cancel(); });
    itself = &stopping;
    EXPECT_THROW(work(stopping), Cancelled) << of << " goes on though it was cancelled";
}

}  // namespace stereonav::test
