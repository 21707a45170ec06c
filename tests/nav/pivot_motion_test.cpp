// Heads about a pivot: they keep their distance when they turn, see the pivot under the same ray when they
// pan and zoom, never pass it, and gather no roll; in scenes of any size.
#include "engine/nav/pivot_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/base/error.h"
#include "engine/camera/stereo_rig.h"

namespace stereonav {
namespace {
using std::numbers::pi;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A scene of this size in metres, whose pivot is not in the picture's middle.
struct Subject {
    explicit Subject(double metres)
        : size(metres),
          head(poseFromAngles(metres * glm::dvec3(0.3, -4, 1.2), 0.2, -0.25, 0)),
          motion({1e-3 * metres, 1e3 * metres}) {
        motion.setPivot(metres * glm::dvec3(0.4, 0.1, 0.2));
        lens.width = 640;
        lens.height = 480;
    }
    glm::dvec3 seen(const Pose& from) const { return makeEyeView(from, lens).project(motion.pivot()); }
    double distance(const Pose& from) const { return glm::distance(from.position, motion.pivot()); }

    double size;
    Pose head;
    PivotMotion motion;
    Lens lens;
};

constexpr double kSizes[] = {1e-12, 0.3, 1e12};

TEST(PivotMotion, TurningKeepsTheDistanceAndThePivotsPlace) {
    for (const double size : kSizes) {
        const Subject subject(size);
        Pose head = subject.head;
        for (int n = 0; n < 1000; ++n) head = subject.motion.turned(head, 0.011, n % 40 < 20 ? 0.02 : -0.02);
        EXPECT_NEAR(subject.distance(head) / subject.distance(subject.head), 1, 1e-11) << size;
        const glm::dvec3 before = subject.seen(subject.head), after = subject.seen(head);
        EXPECT_NEAR(after.x, before.x, 1e-7) << size;
        EXPECT_NEAR(after.y, before.y, 1e-7) << size;
        EXPECT_NEAR(anglesOf(head).roll, 0, 1e-12) << size;
        EXPECT_NEAR(std::remainder(anglesOf(head).heading - 0.2 - 11, 2 * pi), 0, 1e-9) << size;
    }
}

TEST(PivotMotion, TurningGoesTheWayOfTheHand) {
    const Subject subject(1);
    const Pose head = subject.motion.turned(poseFromAngles({0.4, -4, 0.2}, 0, 0, 0), pi / 2, 0);
    EXPECT_NEAR(head.position.x, 0.4 - 4.1, 1e-12) << "from the west: what lay in front went to the right";
    EXPECT_NEAR(head.position.y, 0.1, 1e-12);
    EXPECT_NEAR(head.forward().x, 1, 1e-12);
    const Pose above = subject.motion.turned(poseFromAngles({0.4, -4, 0.2}, 0, 0, 0), 0, -0.5);
    EXPECT_GT(above.position.z, 0.2) << "down turns the top towards the viewer";
}

TEST(PivotMotion, PolesAreTheEndAndLeaveTheHeadingAlone) {
    const Subject subject(1);
    for (const double way : {-1.0, 1.0}) {
        Pose head = subject.motion.turned(subject.head, 0, way * 10);
        EXPECT_NEAR(head.forward().z, way, 1e-15);
        EXPECT_NEAR(subject.distance(head), subject.distance(subject.head), 1e-12);
        for (int n = 0; n < 100; ++n) head = subject.motion.turned(head, 0.01, way);
        EXPECT_NEAR(anglesOf(head).heading, 1.2, 1e-9) << "it turns about the pole as anywhere";
        head = subject.motion.turned(head, 0, -way * 0.7);
        EXPECT_NEAR(anglesOf(head).heading, 1.2, 1e-7) << "and comes back as it went";
        EXPECT_NEAR(anglesOf(head).pitch, way * (pi / 2 - 0.7), 1e-7);
        EXPECT_NEAR(anglesOf(head).roll, 0, 1e-7);
    }
}

TEST(PivotMotion, ARollThatThereWasStays) {
    const Subject subject(1);
    const Pose head = subject.motion.turned(poseFromAngles(subject.head.position, 0.2, -0.25, 0.4), 1, 0.3);
    EXPECT_NEAR(anglesOf(head).roll, 0.4, 1e-12);
}

TEST(PivotMotion, PanningTakesThePivotAlongUnderThePointer) {
    for (const double size : kSizes) {
        const Subject subject(size);
        const EyeView view = makeEyeView(subject.head, subject.lens);
        const Pose head =
            subject.motion.panned(subject.head, {37 * view.pixelWidth(), -21 * view.pixelHeight()});
        const glm::dvec3 before = subject.seen(subject.head), after = subject.seen(head);
        EXPECT_NEAR(after.x, before.x + 37, 1e-8) << size;
        EXPECT_NEAR(after.y, before.y + 21, 1e-8) << size << ": rows go down";
        EXPECT_EQ(head.orientation, subject.head.orientation);
        // Both eyes see it move as far.
        const StereoSetting eyes{0.1 * size, 4 * size};
        Lens near = subject.lens;
        near.nearDepth = 0.01 * size;
        const StereoViews from = makeStereoViews(subject.head, near, eyes);
        const StereoViews to = makeStereoViews(head, near, eyes);
        const glm::dvec3& pivot = subject.motion.pivot();
        EXPECT_NEAR(to.left.project(pivot).x - from.left.project(pivot).x, 37, 1e-8) << size;
        EXPECT_NEAR(to.right.project(pivot).x - from.right.project(pivot).x, 37, 1e-8) << size;
    }
}

Pose zoomedOut(PivotMotion& motion, Pose head, double dt) {
    for (int n = 0; n < 10000 && motion.zooming(); ++n) head = motion.zoomed(head, dt);
    return head;
}

TEST(PivotMotion, ZoomingKeepsThePivotUnderThePointersRay) {
    for (const double size : kSizes) {
        Subject subject(size);
        subject.motion.zoomBy(0.5);
        subject.motion.zoomBy(0.5);
        Pose head = subject.head;
        const glm::dvec3 before = subject.seen(head);
        double distance = subject.distance(head);
        while (subject.motion.zooming()) {
            head = subject.motion.zoomed(head, 1.0 / 60);
            EXPECT_NEAR(subject.seen(head).x, before.x, 1e-8) << size;
            EXPECT_NEAR(subject.seen(head).y, before.y, 1e-8) << size;
            EXPECT_LT(subject.distance(head), distance) << "never back";
            distance = subject.distance(head);
        }
        EXPECT_NEAR(distance / subject.distance(subject.head), 0.25, 1e-12) << size;
        EXPECT_EQ(head.orientation, subject.head.orientation);
    }
}

TEST(PivotMotion, ZoomingDoesNotDependOnTheFrameRate) {
    Subject fine(1), coarse(1);
    fine.motion.zoomBy(3);
    coarse.motion.zoomBy(3);
    Pose head = fine.head;
    for (int n = 0; n < 10; ++n) head = fine.motion.zoomed(head, 0.01);
    EXPECT_NEAR(fine.distance(head), coarse.distance(coarse.motion.zoomed(coarse.head, 0.1)), 1e-9);
    EXPECT_NEAR(fine.distance(zoomedOut(fine.motion, head, 0.01)), 3 * fine.distance(fine.head), 1e-9);
}

TEST(PivotMotion, ZoomingEndsBeforeThePivotAndBeforeInfinity) {
    for (const double size : kSizes) {
        Subject subject(size);
        for (int n = 0; n < 1000; ++n) subject.motion.zoomBy(0.1);
        Pose head = zoomedOut(subject.motion, subject.head, 0.05);
        EXPECT_NEAR(subject.distance(head) / size, 1e-3, 1e-15) << size;
        EXPECT_GT(glm::dot(subject.motion.pivot() - head.position, head.forward()), 0) << "not passed";
        for (int n = 0; n < 1000; ++n) subject.motion.zoomBy(10);
        head = zoomedOut(subject.motion, head, 0.05);
        EXPECT_NEAR(subject.distance(head) / size, 1e3, 1e-9) << size;
        subject.motion.zoomBy(0.5);
        head = zoomedOut(subject.motion, head, 0.05);
        EXPECT_NEAR(subject.distance(head) / size, 500, 1e-9) << "and back again";
    }
}

TEST(PivotMotion, OutsideItsRangeAHeadOnlyGoesTowardsIt) {
    Subject subject(1);
    subject.motion.setPivot(subject.head.position + 1e-6 * subject.head.forward());
    subject.motion.zoomBy(0.5);
    Pose head = zoomedOut(subject.motion, subject.head, 0.05);
    EXPECT_NEAR(subject.distance(head), 1e-6, 1e-12) << "as near as it was";
    subject.motion.zoomBy(4);
    head = zoomedOut(subject.motion, head, 0.05);
    EXPECT_NEAR(subject.distance(head), 4e-6, 1e-12);
}

TEST(PivotMotion, NumbersThatAreNoneChangeNothing) {
    Subject subject(1);
    const glm::dvec3 pivot = subject.motion.pivot();
    subject.motion.setPivot({0, kNaN, 0});
    subject.motion.setPivot({kInfinite, 0, 0});
    EXPECT_EQ(subject.motion.pivot(), pivot);
    for (const double factor : {0.0, -1.0, kNaN, kInfinite}) subject.motion.zoomBy(factor);
    EXPECT_FALSE(subject.motion.zooming());
    EXPECT_EQ(subject.motion.panned(subject.head, {kNaN, 0}).position, subject.head.position);
    EXPECT_NEAR(
        glm::distance(subject.motion.turned(subject.head, kNaN, kNaN).position, subject.head.position), 0,
        1e-12);
    subject.motion.zoomBy(2);
    EXPECT_EQ(subject.motion.zoomed(subject.head, kNaN).position, subject.head.position);
    EXPECT_EQ(subject.motion.zoomed(subject.head, -1).position, subject.head.position);
    for (const PivotMotion::Range range : {PivotMotion::Range{0, 1}, {2, 1}, {1, kInfinite}, {kNaN, 1}})
        EXPECT_THROW(PivotMotion{range}, Error);
}

TEST(PivotMotion, APivotAtTheEyeIsTurnedAbout) {
    Subject subject(1);
    subject.motion.setPivot(subject.head.position);
    EXPECT_NEAR(glm::distance(subject.motion.turned(subject.head, 1, 0.1).position, subject.head.position), 0,
                1e-12);
    subject.motion.zoomBy(2);
    EXPECT_EQ(subject.motion.zoomed(subject.head, 1).position, subject.head.position);
    EXPECT_FALSE(subject.motion.zooming());
}

}  // namespace
}  // namespace stereonav
