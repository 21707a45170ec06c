#include "app/view/keyframe_edit.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace stereonav {
namespace {

constexpr std::size_t kMostSteps = 200, kMostHandles = 60;
constexpr double kShortest = 0.1;                         // least seconds from one keyframe to the next
constexpr double kOff = 0.01;                             // share of a path's length
constexpr double kOffAngle = 4 * std::numbers::pi / 180;  // radians
constexpr double kLeastOff = 1e-6;                        // metres
constexpr std::size_t kRaisedAround = 60;                 // samples: a second to each side

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double secondsBetween(const Pose& from, const Pose& to, double metresPerSecond) {
    return timedKeyframes({from, to}, metresPerSecond).back().time;
}

// Moves keyframe `from` and all later ones by `seconds`.
void moveOn(Keyframes& keys, std::size_t from, double seconds) {
    for (std::size_t n = from; n < keys.size(); ++n) keys[n].time += seconds;
}

// Stretches the time to key `next` in proportion to its distance.
void keepPace(Keyframes& keys, const Keyframes& before, std::size_t next) {
    const auto way = [&](const Keyframes& of) {
        return glm::distance(of[next - 1].pose.position, of[next].pose.position);
    };
    const double seconds = before[next].time - before[next - 1].time, was = way(before);
    if (!(was > 0)) return;  // the viewer did not move there
    const double now = std::max(seconds * way(keys) / was, kShortest);
    moveOn(keys, next, now - (keys[next].time - keys[next - 1].time));
}

double pathLength(const RecordedPath& path) {
    double length = 0;
    const auto& samples = path.samples();
    for (std::size_t n = 1; n < samples.size(); ++n)
        length += glm::distance(samples[n - 1].pose.position, samples[n].pose.position);
    return length;
}

// Returns, for each place, the largest value within `around` places to each side.
std::vector<double> largestAround(const std::vector<double>& values, std::size_t around) {
    std::vector<double> largest(values.size());
    std::deque<std::size_t> falling;  // places with falling values
    for (std::size_t next = 0, at = 0; at < values.size(); ++at) {
        for (; next < values.size() && next <= at + around; ++next) {
            while (!falling.empty() && values[falling.back()] <= values[next]) falling.pop_back();
            falling.push_back(next);
        }
        while (falling.front() + around < at) falling.pop_front();
        largest[at] = values[falling.front()];
    }
    return largest;
}

std::vector<double> meanAround(const std::vector<double>& values, std::size_t around) {
    std::vector<double> sums(values.size() + 1, 0.0), mean(values.size());
    for (std::size_t n = 0; n < values.size(); ++n) sums[n + 1] = sums[n] + values[n];
    for (std::size_t n = 0; n < values.size(); ++n) {
        const std::size_t from = n > around ? n - around : 0, to = std::min(n + around + 1, values.size());
        mean[n] = (sums[to] - sums[from]) / static_cast<double>(to - from);
    }
    return mean;
}

// Raises the flight smoothly: the mean of the local largest heights is nowhere less than the missing height.
void raise(std::vector<PathSample>& samples, const Flight& flight) {
    std::vector<double> missing(samples.size(), 0.0);
    bool any = false;
    for (std::size_t n = 0; n < samples.size(); ++n) {
        const auto height = heightOverGround(flight, samples[n].pose.position);
        if (!height || !(*height < 0)) continue;
        missing[n] = -*height;
        any = true;
    }
    if (!any) return;
    const std::vector<double> raised = meanAround(largestAround(missing, kRaisedAround), kRaisedAround);
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n].pose.position.z += std::max(raised[n], missing[n]);
}

}  // namespace

void KeyframeEdit::show(Keyframes keys) {
    mKeys = std::move(keys);
    mDragged.reset();
    if (mChosen && *mChosen >= mKeys.size()) mChosen.reset();
    ++mVersion;
}

void KeyframeEdit::change(Keyframes keys, std::optional<std::size_t> chosen) {
    mBefore.push_back(mKeys);
    if (mBefore.size() > kMostSteps) mBefore.erase(mBefore.begin());
    mAfter.clear();
    mChosen = chosen;
    show(std::move(keys));
}

void KeyframeEdit::choose(std::optional<std::size_t> key) {
    mChosen = key && *key < mKeys.size() ? key : std::nullopt;
}

void KeyframeEdit::start(Keyframes keys) {
    mBefore.clear();
    mAfter.clear();
    mChosen.reset();
    show(std::move(keys));
}

void KeyframeEdit::add(const Pose& eye, double metresPerSecond) {
    endDrag();
    Keyframes keys = mKeys;
    if (keys.empty()) {
        insertKeyframe(keys, {0, eye});
        return change(std::move(keys), 0);
    }
    const std::size_t before = mChosen.value_or(keys.size() - 1), place = before + 1;
    const double there = secondsBetween(keys[before].pose, eye, metresPerSecond);
    if (place < keys.size()) {
        const double on = secondsBetween(eye, keys[place].pose, metresPerSecond);
        moveOn(keys, place, there + on - (keys[place].time - keys[before].time));
    }
    insertKeyframe(keys, {keys[before].time + there, eye});
    change(std::move(keys), place);
}

void KeyframeEdit::removeChosen() {
    endDrag();
    if (!mChosen) return;
    Keyframes keys = mKeys;
    removeKeyframe(keys, *mChosen);
    change(std::move(keys), *mChosen > 0 ? std::optional(*mChosen - 1) : std::nullopt);
}

void KeyframeEdit::beginDrag(std::size_t key) {
    endDrag();
    if (key >= mKeys.size()) return;
    mChosen = mDragged = key;
    mBeforeDrag = mKeys;
}

void KeyframeEdit::dragTo(const glm::dvec3& place) {
    if (!mDragged || !isFinite(place)) return;
    const std::size_t key = *mDragged;
    Keyframes keys = mBeforeDrag;
    keys[key].pose.position = place;
    if (key > 0) keepPace(keys, mBeforeDrag, key);
    if (key + 1 < keys.size()) keepPace(keys, mBeforeDrag, key + 1);
    mKeys = std::move(keys);
    ++mVersion;
}

void KeyframeEdit::endDrag() {
    if (!mDragged) return;
    const std::size_t key = *std::exchange(mDragged, std::nullopt);
    if (mKeys[key].pose.position == mBeforeDrag[key].pose.position) return;
    Keyframes keys = std::exchange(mKeys, mBeforeDrag);
    change(std::move(keys), key);
}

void KeyframeEdit::undo() {
    if (mBefore.empty()) return;
    mAfter.push_back(mDragged ? mBeforeDrag : mKeys);
    Keyframes keys = std::move(mBefore.back());
    mBefore.pop_back();
    show(std::move(keys));
}

void KeyframeEdit::redo() {
    if (mAfter.empty()) return;
    mBefore.push_back(mDragged ? mBeforeDrag : mKeys);
    Keyframes keys = std::move(mAfter.back());
    mAfter.pop_back();
    show(std::move(keys));
}

Keyframes keyframesToEdit(const RecordedPath& path) {
    double metres = std::max(kOff * pathLength(path), kLeastOff), radians = kOffAngle;
    for (;;) {
        Keyframes keys = keyframesOf(path, metres, radians);
        if (keys.size() <= kMostHandles) return keys;
        metres *= 2;
        radians *= 2;
    }
}

std::optional<double> heightOverGround(const Flight& flight, const glm::dvec3& place) {
    const double height = place.z - flight.lowestAt(place);
    return std::isfinite(height) ? std::optional(height) : std::nullopt;
}

glm::dvec3 overGround(const Flight& flight, const glm::dvec3& from, const glm::dvec2& to) {
    glm::dvec3 place(to, from.z);
    const auto height = heightOverGround(flight, from), there = heightOverGround(flight, place);
    if (there) place.z += std::max(height.value_or(*there), 0.0) - *there;
    return place;
}

FlownPath flownThrough(const Keyframes& keys, const Flight& flight) {
    FlownPath flown;
    if (keys.size() < 2) return flown;
    std::vector<PathSample> samples = pathThrough(keys, true).samples();
    raise(samples, flight);
    flown.blocked.assign(samples.size() - 1, 0);
    for (std::size_t n = 1; n < samples.size(); ++n) {
        const bool clear = flight.wayIsClear(samples[n - 1].pose.position, samples[n].pose.position);
        flown.blocked[n - 1] = clear ? 0 : 1;
        flown.anyBlocked |= !clear;
    }
    flown.path = RecordedPath(std::move(samples), "keyframes");
    return flown;
}

}  // namespace stereonav
