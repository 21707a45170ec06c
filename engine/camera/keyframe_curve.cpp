#include "engine/camera/keyframe_curve.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr std::size_t kMeasures = 64;  // chords that a piece is measured by
constexpr double kStill = 1e-9;        // radians: less is no turn
constexpr double kMostSpin = 2;        // times the slower side's
constexpr double kMonotone = 3;        // times the slower side's (Fritsch and Carlson)

// Parameter of the j-th place at which a piece's length is measured: denser near its ends, where a sharp turn
// makes the spline slow.
double measuredAt(std::size_t j) {
    const double u = static_cast<double>(j) / kMeasures;
    return u * u * (3 - 2 * u);
}

// The rotation vector of a unit quaternion, by the shorter way.
glm::dvec3 logOf(glm::dquat q) {
    if (q.w < 0) q = -q;
    const glm::dvec3 v(q.x, q.y, q.z);
    const double sine = glm::length(v);
    if (sine < 1e-12) return 2.0 * v;
    return v * (2 * std::atan2(sine, q.w) / sine);
}

glm::dquat expOf(const glm::dvec3& turn) {
    const double angle = glm::length(turn);
    if (angle < 1e-12) return glm::normalize(glm::dquat(1, 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z));
    return glm::angleAxis(angle, turn / angle);
}

// The tangent of a non-uniform Catmull-Rom spline at the middle one of three, for steps before and after it.
template <typename T>
T tangentOf(const T& before, const T& after, double stepBefore, double stepAfter) {
    return (before * (stepAfter / stepBefore) + after * (stepBefore / stepAfter)) / (stepBefore + stepAfter);
}

}  // namespace

KeyframeCurve::KeyframeCurve(const std::vector<PathSample>& keyframes, bool easeEnds)
    : mKeys(RecordedPath(keyframes, "keyframes").samples()) {
    for (std::size_t k = 1; k < mKeys.size(); ++k)
        if (glm::dot(mKeys[k - 1].pose.orientation, mKeys[k].pose.orientation) < 0)
            mKeys[k].pose.orientation = -mKeys[k].pose.orientation;
    findTangents();
    measure();
    findSpeeds(easeEnds);
    findSpins(easeEnds);
}

void KeyframeCurve::findTangents() {
    const std::size_t pieces = mKeys.size() - 1;
    mPieces.resize(pieces);
    std::vector<glm::dvec3> ways(pieces);
    std::vector<double> knots(pieces);  // centripetal: the square root of the way
    for (std::size_t k = 0; k < pieces; ++k) {
        ways[k] = mKeys[k + 1].pose.position - mKeys[k].pose.position;
        knots[k] = std::sqrt(glm::length(ways[k]));
    }
    // At its ends the spline goes straight; at a stop it has no direction.
    for (std::size_t k = 0; k < pieces; ++k) {
        if (!(knots[k] > 0)) continue;
        const bool before = k > 0 && knots[k - 1] > 0, after = k + 1 < pieces && knots[k + 1] > 0;
        const bool stopsBefore = k > 0 && !before, stopsAfter = k + 1 < pieces && !after;
        Piece& piece = mPieces[k];
        piece.fromTangent = before        ? knots[k] * tangentOf(ways[k - 1], ways[k], knots[k - 1], knots[k])
                            : stopsBefore ? glm::dvec3(0.0)
                                          : ways[k];
        piece.toTangent = after        ? knots[k] * tangentOf(ways[k], ways[k + 1], knots[k], knots[k + 1])
                          : stopsAfter ? glm::dvec3(0.0)
                                       : ways[k];
    }
}

glm::dvec3 KeyframeCurve::place(std::size_t k, double t) const {
    const glm::dvec3 &a = mKeys[k].pose.position, &b = mKeys[k + 1].pose.position;
    const double left = 1 - t;
    return a + (t * t * (3 - 2 * t)) * (b - a) + (t * left * left) * mPieces[k].fromTangent -
           (t * t * left) * mPieces[k].toTangent;
}

double KeyframeCurve::rate(std::size_t k, double t) const {
    const glm::dvec3 way = mKeys[k + 1].pose.position - mKeys[k].pose.position;
    const double left = 1 - t;
    return glm::length((6 * t * left) * way + (left * (1 - 3 * t)) * mPieces[k].fromTangent +
                       (t * (3 * t - 2)) * mPieces[k].toTangent);
}

// Lengths by Gauss and Legendre's rule of three places.
void KeyframeCurve::measure() {
    constexpr double kOff = 0.3872983346207417, kSide = 5.0 / 18, kMiddle = 8.0 / 18;
    mAlong.assign(mKeys.size(), 0);
    for (std::size_t k = 0; k < mPieces.size(); ++k) {
        Piece& piece = mPieces[k];
        piece.lengths.assign(kMeasures + 1, 0);
        piece.slopes.assign(kMeasures + 1, 0);
        for (std::size_t j = 0; j <= kMeasures; ++j) {
            const double there = measuredAt(j), speed = rate(k, there);
            piece.slopes[j] = speed > 0 ? 1 / speed : std::numeric_limits<double>::infinity();
            if (j == 0) continue;
            const double before = measuredAt(j - 1), width = there - before;
            const double middle = 0.5 * (before + there), off = kOff * width;
            piece.lengths[j] =
                piece.lengths[j - 1] +
                width * (kSide * (rate(k, middle - off) + rate(k, middle + off)) + kMiddle * rate(k, middle));
        }
        mAlong[k + 1] = mAlong[k] + piece.lengths.back();
    }
}

// Returns the parameter by monotone cubics between the measured places, so that the speed is the wanted one
// there and has no steps.
double KeyframeCurve::parameterAt(const Piece& piece, double along) const {
    const std::vector<double>& lengths = piece.lengths;
    const auto after = std::upper_bound(lengths.begin(), lengths.end() - 1, along);
    const auto j = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - lengths.begin(), 1)) - 1;
    const double chord = lengths[j + 1] - lengths[j];
    const double first = measuredAt(j), width = measuredAt(j + 1) - first;
    if (!(chord > 0)) return first;
    const double t = std::clamp((along - lengths[j]) / chord, 0.0, 1.0), left = 1 - t;
    const double from = std::min(piece.slopes[j] * chord / width, kMonotone),
                 to = std::min(piece.slopes[j + 1] * chord / width, kMonotone);
    const double share = t * t * (3 - 2 * t) + t * left * left * from - t * t * left * to;
    return first + share * width;
}

// Monotone: no more than three times the slower neighbour's mean speed.
void KeyframeCurve::findSpeeds(bool easeEnds) {
    const std::size_t last = mKeys.size() - 1;
    const auto mean = [&](std::size_t k) {
        return (mAlong[k + 1] - mAlong[k]) / (mKeys[k + 1].time - mKeys[k].time);
    };
    mSpeed.assign(mKeys.size(), 0);
    for (std::size_t k = 1; k < last; ++k) {
        const double before = mKeys[k].time - mKeys[k - 1].time, after = mKeys[k + 1].time - mKeys[k].time;
        const double speed = (after * mean(k - 1) + before * mean(k)) / (before + after);
        mSpeed[k] = std::min(speed, kMonotone * std::min(mean(k - 1), mean(k)));
    }
    if (easeEnds) return;
    mSpeed[0] = mean(0);
    mSpeed[last] = mean(last - 1);
}

void KeyframeCurve::findSpins(bool easeEnds) {
    const std::size_t last = mKeys.size() - 1;
    std::vector<glm::dvec3> means(last);
    for (std::size_t k = 0; k < last; ++k) {
        const glm::dvec3 turn =
            logOf(glm::conjugate(mKeys[k].pose.orientation) * mKeys[k + 1].pose.orientation);
        means[k] = glm::length(turn) > kStill ? turn / (mKeys[k + 1].time - mKeys[k].time) : glm::dvec3(0.0);
    }
    mSpin.assign(mKeys.size(), glm::dvec3(0.0));
    for (std::size_t k = 1; k < last; ++k) {
        const double before = mKeys[k].time - mKeys[k - 1].time, after = mKeys[k + 1].time - mKeys[k].time;
        const glm::dvec3 spin = (after * means[k - 1] + before * means[k]) / (before + after);
        const double most = kMostSpin * std::min(glm::length(means[k - 1]), glm::length(means[k])),
                     size = glm::length(spin);
        mSpin[k] = size > most ? spin * (most / size) : spin;
    }
    if (easeEnds) return;
    mSpin[0] = means[0];
    mSpin[last] = means[last - 1];
}

Pose KeyframeCurve::at(double time) const {
    if (!(time > startTime())) return mKeys.front().pose;
    if (time >= endTime()) return mKeys.back().pose;
    const auto next = std::upper_bound(mKeys.begin(), mKeys.end(), time,
                                       [](double t, const PathSample& key) { return t < key.time; });
    const auto k = static_cast<std::size_t>(next - mKeys.begin()) - 1;
    const double seconds = mKeys[k + 1].time - mKeys[k].time, t = (time - mKeys[k].time) / seconds,
                 left = 1 - t;

    const Piece& piece = mPieces[k];
    const double along = piece.lengths.back() * (t * t * (3 - 2 * t)) +
                         seconds * (t * left * left * mSpeed[k] - t * t * left * mSpeed[k + 1]);
    const glm::dvec3 position = place(k, parameterAt(piece, along));

    const glm::dquat &a = mKeys[k].pose.orientation, &d = mKeys[k + 1].pose.orientation;
    const glm::dquat b = a * expOf(mSpin[k] * (seconds / 3)), c = d * expOf(-mSpin[k + 1] * (seconds / 3));
    const glm::dquat ab = glm::slerp(a, b, t), bc = glm::slerp(b, c, t), cd = glm::slerp(c, d, t);
    return {position, glm::normalize(glm::slerp(glm::slerp(ab, bc, t), glm::slerp(bc, cd, t), t))};
}

}  // namespace stereonav
