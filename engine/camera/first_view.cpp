#include "engine/camera/first_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr int kViewTurns = 12;
constexpr double kPitches[] = {-0.2, -0.5, -0.9};  // radians: from above
constexpr double kPitchPrior[] = {1, 0.97, 0.7};   // what stands is rather seen from the side
constexpr double kFlightFill = 0.96;               // share of the picture on the flight around
constexpr int kGrid = 72;                          // pixels of a coarse picture along each side
constexpr int kNormalSteps = 6;                    // classes of normals along each axis of a map
constexpr int kNormalClasses = kNormalSteps * kNormalSteps;
constexpr int kOutline = 240;  // directions in which the outermost sample is kept

// Returns the axes of a viewer with these angles.
struct ViewAxes {
    glm::dvec3 right, up, forward;
};
ViewAxes axesOf(double turn, double pitch) {
    const Pose pose = poseFromAngles(glm::dvec3(0.0), turn, pitch, 0);
    return {pose.right(), pose.up(), pose.forward()};
}

// The class of a normal on the octahedral map, after Meyer et al. 2010.
int classOf(const glm::vec3& normal) {
    const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    glm::vec2 at(normal.x / sum, normal.y / sum);
    if (normal.z < 0) {
        const glm::vec2 folded(1 - std::abs(at.y), 1 - std::abs(at.x));
        at = {at.x < 0 ? -folded.x : folded.x, at.y < 0 ? -folded.y : folded.y};
    }
    const auto step = [](float x) {
        return std::clamp(static_cast<int>((0.5f * x + 0.5f) * kNormalSteps), 0, kNormalSteps - 1);
    };
    return step(at.y) * kNormalSteps + step(at.x);
}

struct Ball {
    glm::dvec3 middle{0.0};
    double radius = 0;
};
// Returns the ball about the middle of the samples' box.
Ball ballOf(const std::vector<SurfaceSample>& samples, double least) {
    glm::dvec3 low = samples[0].place, high = low;
    for (const SurfaceSample& sample : samples) {
        low = glm::min(low, sample.place);
        high = glm::max(high, sample.place);
    }
    Ball ball{0.5 * low + 0.5 * high, 0};
    for (const SurfaceSample& sample : samples)
        ball.radius = std::max(ball.radius, glm::length(sample.place - ball.middle));
    ball.radius = std::max(ball.radius, least);
    return ball;
}

// A coarse picture of the samples: the nearest one in each pixel.
class CoarsePicture {
public:
    CoarsePicture(const std::vector<SurfaceSample>& samples, const std::vector<std::uint8_t>& classes,
                  const Ball& ball, const ViewAxes& axes) {
        mNearest.fill(2);
        mClass.fill(-1);
        const double scale = 1 / ball.radius;
        for (std::size_t n = 0; n < samples.size(); ++n) {
            const SurfaceSample& sample = samples[n];
            const glm::dvec3 away = scale * (sample.place - ball.middle);
            const int pixel = cell(glm::dot(away, axes.up)) * kGrid + cell(glm::dot(away, axes.right));
            const auto depth = static_cast<float>(glm::dot(away, axes.forward));
            if (depth >= mNearest[pixel]) continue;
            mNearest[pixel] = depth;
            mClass[pixel] = classes[n];
        }
    }

    // Returns how much is to be seen: the share of the ball's picture that is covered, by the entropy of the
    // normals there (Vazquez et al. 2001 take the entropy of faces).
    double relief() const {
        std::array<int, kNormalClasses> counts{};
        int covered = 0;
        for (const int normals : mClass) {
            if (normals < 0) continue;
            ++covered;
            ++counts[normals];
        }
        if (covered == 0) return 0;
        double entropy = 0;
        for (const int count : counts)
            if (count > 0) entropy -= count * std::log(static_cast<double>(count) / covered) / covered;
        const double share = covered / (0.25 * kPi * kGrid * kGrid);
        return std::sqrt(share) * (0.3 + entropy / std::log(kNormalClasses));
    }

private:
    static int cell(double x) { return std::clamp(static_cast<int>((0.5 * x + 0.5) * kGrid), 0, kGrid - 1); }

    std::array<float, static_cast<std::size_t>(kGrid) * kGrid> mNearest;
    std::array<int, static_cast<std::size_t>(kGrid) * kGrid> mClass;
};

struct Direction {
    double turn = 0, pitch = kPitches[0];
};
// Returns the direction that shows most; of equal ones that nearest to the north.
Direction bestDirection(const std::vector<SurfaceSample>& samples, const Ball& ball, double front) {
    std::vector<std::uint8_t> classes(samples.size());
    for (std::size_t n = 0; n < samples.size(); ++n)
        classes[n] = samples[n].normal == glm::vec3(0.0f)
                         ? std::uint8_t{0}
                         : static_cast<std::uint8_t>(classOf(samples[n].normal));
    std::array<double, kViewTurns * std::size(kPitches)> scores{};
    const auto directionOf = [](int n) {
        // 0, 30, -30, 60, ... degrees: the first of equal ones counts.
        const int step = n % kViewTurns, side = (step + 1) / 2 * (step % 2 == 1 ? 1 : -1);
        return Direction{2 * kPi * side / kViewTurns, kPitches[n / kViewTurns]};
    };
    parallelFor(static_cast<int>(scores.size()), [&](int n) {
        const Direction direction = directionOf(n);
        const CoarsePicture picture(samples, classes, ball, axesOf(direction.turn, direction.pitch));
        scores[n] = picture.relief() * kPitchPrior[n / kViewTurns] * (1 + front * std::cos(direction.turn));
    });
    int best = 0;
    for (int n = 1; n < static_cast<int>(scores.size()); ++n)
        if (scores[n] > (1 + 1e-9) * scores[best]) best = n;
    return directionOf(best);
}

// Returns the samples that are outermost in some direction: the corners of all projections, nearly.
std::vector<glm::dvec3> outlineOf(const std::vector<SurfaceSample>& samples, const Ball& ball) {
    std::vector<glm::dvec3> outline(kOutline);
    parallelFor(kOutline, [&](int n) {
        // Points of a spiral on the sphere, which are spread evenly.
        const double z = 1 - (2 * n + 1.0) / kOutline, across = std::sqrt(1 - z * z), turn = 2.399963 * n;
        const glm::dvec3 direction(across * std::cos(turn), across * std::sin(turn), z);
        double most = -kInfinity;
        for (const SurfaceSample& sample : samples) {
            const glm::dvec3 away = sample.place - ball.middle;
            if (const double there = glm::dot(away, direction); there > most) {
                most = there;
                outline[n] = away;
            }
        }
    });
    return outline;
}

// The tangents from the middle of a picture to where an object may reach.
struct Window {
    double across, up;
};

// Returns the least distance from `about` at which all of the outline lies in the window.
double distanceFor(const std::vector<glm::dvec3>& outline, const glm::dvec3& about, const ViewAxes& axes,
                   const Window& window) {
    double distance = 0;
    for (const glm::dvec3& point : outline) {
        const glm::dvec3 away = point - about;
        const double deep = glm::dot(away, axes.forward);
        distance = std::max({distance, std::abs(glm::dot(away, axes.right)) / window.across - deep,
                             std::abs(glm::dot(away, axes.up)) / window.up - deep});
    }
    return distance;
}

// Returns the place that the viewer looks at for the object to lie in the middle of the picture; moved across
// the view by steps, as its projection depends on the distance.
glm::dvec3 middleSeen(const std::vector<glm::dvec3>& outline, const ViewAxes& axes, const Window& window,
                      double least) {
    constexpr int kSteps = 12;
    glm::dvec3 about(0.0);
    for (int step = 0; step < kSteps; ++step) {
        const double distance = std::max(distanceFor(outline, about, axes, window), least);
        glm::dvec2 low(kInfinity), high(-kInfinity);
        for (const glm::dvec3& point : outline) {
            const glm::dvec3 away = point - about;
            const double deep = std::max(distance + glm::dot(away, axes.forward), 1e-6 * distance);
            const glm::dvec2 seen(glm::dot(away, axes.right) / deep, glm::dot(away, axes.up) / deep);
            low = glm::min(low, seen);
            high = glm::max(high, seen);
        }
        const glm::dvec2 off = 0.5 * distance * (low + high);
        about += off.x * axes.right + off.y * axes.up;
    }
    return about;
}

}  // namespace

std::optional<FirstView> firstViewOf(const std::vector<SurfaceSample>& samples, const ViewWanted& wanted) {
    if (samples.empty() || !(wanted.aspect > 0) || !(wanted.verticalFov > 0)) return std::nullopt;
    const Ball ball = ballOf(samples, wanted.least);
    if (!std::isfinite(glm::dot(ball.middle, ball.middle) + ball.radius)) return std::nullopt;
    const Direction best = bestDirection(samples, ball, wanted.front);
    const std::vector<glm::dvec3> outline = outlineOf(samples, ball);
    const double half = std::tan(0.5 * wanted.verticalFov), shorter = half * std::min(1.0, wanted.aspect);
    const Window filled{kFirstFill * shorter, kFirstFill * shorter};
    const Window whole{kFlightFill * half * wanted.aspect, kFlightFill * half};
    const ViewAxes axes = axesOf(best.turn, best.pitch);
    // A point, or a line that points at the viewer, is not seen from nearer than its ball would be.
    const double least = ball.radius * (samples.size() > 1 ? 1.05 : 1 / shorter);
    FirstView view;
    view.turn = best.turn;
    view.radius = ball.radius;
    const glm::dvec3 about = middleSeen(outline, axes, filled, least);
    view.orbit = {ball.middle + about, std::max(distanceFor(outline, about, axes, filled), least),
                  best.pitch};
    view.flight = view.orbit;
    constexpr int kFlightTurns = 36;
    for (int n = 0; n < kFlightTurns; ++n)
        view.flight.distance =
            std::max(view.flight.distance,
                     distanceFor(outline, about, axesOf(2 * kPi * n / kFlightTurns, best.pitch), whole));
    return view;
}

}  // namespace stereonav
