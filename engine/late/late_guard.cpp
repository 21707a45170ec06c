#include "engine/late/late_guard.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace stereonav {
namespace {

constexpr int kLooks = 8;  // at each side
constexpr double kOutliers =
    0.05;  // share of the pictures: a frame that came very late now and then is none to plan for

// The value that all but the largest ones do not exceed.
double mostOf(std::vector<double> values) {
    const auto last =
        static_cast<std::ptrdiff_t>(std::ceil((1 - kOutliers) * static_cast<double>(values.size()))) - 1;
    std::nth_element(values.begin(), values.begin() + last, values.end());
    return values[static_cast<std::size_t>(last)];
}

}  // namespace

Lens guarded(const Lens& lens, const glm::ivec2& guard) {
    if (guard.x <= 0 && guard.y <= 0) return lens;
    Lens wide = lens;
    wide.width += 2 * guard.x;
    wide.height += 2 * guard.y;
    wide.verticalFov = 2 * std::atan(std::tan(lens.verticalFov / 2) * wide.height / lens.height);
    return wide;
}

glm::dvec2 seenBeyond(const LateEye& eye, const glm::ivec2& guard, const EyeView& to) {
    const EyeView& from = eye.view();
    const LateMove move = lateMove(from, to);
    const glm::dvec2 shown(from.width - 2 * guard.x, from.height - 2 * guard.y);
    glm::dvec2 beyond(0.0);
    const auto look = [&](double x, double y) {
        const auto row = [&](int n) { return move.rows[n][0] * x + move.rows[n][1] * y + move.rows[n][2]; };
        if (!(row(2) > 1e-3)) {
            beyond = glm::dvec2(1.0);
            return;
        }
        const glm::dvec2 infinite(row(0) / row(2), row(1) / row(2));
        const glm::dvec2 shift =
            glm::dvec2(move.shift[0], move.shift[1]) - static_cast<double>(move.shift[2]) * infinite;
        glm::dvec2 place = infinite;
        // The depths at the place determine how far it moves.
        for (int round = 0; round < 2; ++round) {
            const LateTile& tile = eye.tileAt(place.x, place.y);
            place = infinite + 0.5 * static_cast<double>(tile.nearest + tile.farthest) * shift;
        }
        place -= glm::dvec2(guard);
        beyond = glm::max(beyond, glm::max(-place, place - shown) / shown);
    };
    for (int n = 0; n <= kLooks; ++n) {
        const double share = static_cast<double>(n) / kLooks;
        look(share * to.width, 0);
        look(share * to.width, to.height);
        look(0, share * to.height);
        look(to.width, share * to.height);
    }
    return glm::min(beyond, glm::dvec2(1.0));
}

void GuardBand::saw(const glm::dvec2& beyond, double now_s) {
    mSeen.push_back({now_s, beyond});
    while (now_s - mSeen.front().at > kRemembered_s) mSeen.pop_front();
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> values;
        for (const Seen& seen : mSeen) values.push_back(seen.beyond[axis]);
        const int wanted = static_cast<int>(std::ceil(std::min(mostOf(values), kMost) / kStep - 1e-9));
        if (wanted >= mSteps[axis]) {
            mSteps[axis] = wanted;
            mLower[axis] = 0;
            mLowerSince[axis] = now_s;
            continue;
        }
        mLower[axis] = std::max(mLower[axis], wanted);
        if (now_s - mLowerSince[axis] < kHold_s) continue;
        mSteps[axis] = std::exchange(mLower[axis], 0);
        mLowerSince[axis] = now_s;
    }
}

void GuardBand::forget() {
    mSeen.clear();
    mSteps = mLower = glm::ivec2(0);
}

}  // namespace stereonav
