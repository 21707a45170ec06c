// Another study beside the flown one: nothing runs before it is asked for, its place is the matching one,
// swapping works both ways, and a file that is no study is refused while the first goes on.
#include "app/view/second_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/base/error.h"
#include "engine/nav/navigator.h"
#include "engine/scene/capabilities.h"
#include "tests/support/gate.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_frames.h"

namespace stereonav {
namespace {

// Shows one colour for every ray; `drawn` gets the eye's place.
class OneColor final : public EyeRenderer {
public:
    explicit OneColor(PackedColor color) : mColor(color) {}
    std::function<void(double x)> drawn;
    int tileCount(const EyeView&) const override { return 1; }
    void renderTile(const EyeView& view, int, EyeImage& image) const override {
        if (drawn) drawn(view.eye.x);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) image.color.at(x, y) = mColor;
    }
    void renderPixels(const EyeView&, PixelRect, std::span<const PixelIndex>, EyeImage&) const override {}
    bool mayHitBeyondEdge(const EyeView&, PixelRect, double, double) const override { return true; }

private:
    PackedColor mColor;
};

// A line along the x axis from 0 to `length`; places match by their share of it.
class StraightLine final : public Scene, LineThrough, MatchingLine {
public:
    StraightLine(double length, PackedColor color, bool line = true) : mLength(length), mRenderer(color) {
        name = "straight";
        lens.verticalFov = 0.8;
        mRays.renderer = &mRenderer;
        offer(mRays);
        if (!line) return;
        offer<const LineThrough>(*this);
        offer<const MatchingLine>(*this);
    }
    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
    PlaceOnLine placeOnLine(const glm::dvec3& world) const override {
        return {std::clamp(world.x, 0.0, mLength), mLength};
    }
    std::shared_ptr<const LineMatch> matchWith(const Scene& other) const override {
        struct Match final : LineMatch {
            double factor = 1;
            double toOther(double along) const override { return factor * along; }
            double fromOther(double along) const override { return along / factor; }
            double cost() const override { return 0.5; }
            bool matches() const override { return true; }
        };
        auto match = std::make_shared<Match>();
        match->factor = other.offered<const LineThrough>()->placeOnLine({1e9, 0, 0}).along / mLength;
        return match;
    }
    Pose poseOnLine(double along, bool back) const override {
        Pose pose = poseFromAngles({along, 0, 0}, back ? -1.5707963 : 1.5707963, 0, 0);
        return pose;
    }

    OneColor& renderer() { return mRenderer; }

private:
    double mLength;
    OneColor mRenderer;
    RayCast mRays;
    mutable FakeFrames mFrames;
};

std::shared_ptr<const OpenScene> straightLine(double length, PackedColor color, bool line = true) {
    return std::make_shared<const OpenScene>(
        OpenScene{std::make_shared<StraightLine>(length, color, line), {}, {}, 0, false});
}

// Returns true when it is there; throws the exceptions of poll().
bool waitForSecond(SecondStudy& second) {
    bool there = false;
    EXPECT_TRUE(test::waitFor([&] { return (there = second.poll()) || !second.loading(); }));
    return there;
}

TEST(SecondStudy, ShowsTheMatchingPlaceAndSwaps) {
    const PackedColor red = packColor({1, 0, 0}), blue = packColor({0, 0, 1});
    const auto first = straightLine(1, red), other = straightLine(2, blue);
    SecondStudy second([] {});
    EXPECT_FALSE(second.loading());
    EXPECT_FALSE(second.drawing());
    EXPECT_FALSE(second.matching(*first->scene, Pose{})) << "there is none";
    second.open(first, [&](Progress&) { return *other; });
    ASSERT_TRUE(waitForSecond(second));
    EXPECT_FALSE(second.drawing()) << "no thread before a picture is asked for";
    const Pose back = poseFromAngles({0.3, 0, 0}, -1.5, 0, 0);
    const auto place = second.matching(*first->scene, back);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->along, 0.6, 1e-12);
    EXPECT_NEAR(place->length, 2, 1e-12);
    EXPECT_TRUE(place->back);
    EXPECT_NEAR(second.poseAt(*place).position.x, 0.6, 1e-12);
    second.look(*place, {32, 24});
    ASSERT_TRUE(test::waitFor([&] { return second.picture() != nullptr; }));
    EXPECT_EQ(second.picture()->color.width(), 32);
    EXPECT_EQ(second.picture()->color.at(5, 5), blue);
    EXPECT_EQ(second.picture()->of, *place);

    const auto flown = second.swap(first);
    EXPECT_EQ(flown->scene, other->scene);
    EXPECT_EQ(second.other(), first);
    EXPECT_FALSE(second.drawing());
    const auto home = second.matching(*flown->scene, second.poseAt(*place));
    ASSERT_TRUE(home);
    EXPECT_NEAR(home->along, 0.6 / 2, 0.35) << "somewhere on it";
    const auto there = second.matching(*flown->scene, poseFromAngles({0.6, 0, 0}, -1.5, 0, 0));
    EXPECT_NEAR(there->along, 0.3, 1e-12) << "where it came from";
    EXPECT_TRUE(there->back);
}

TEST(SecondStudy, RefusesWhatHasNoLineAndForgetsWhatIsNotWanted) {
    const auto first = straightLine(1, 0);
    SecondStudy second([] {});
    second.open(first, [](Progress&) { return *straightLine(2, 0, false); });
    try {
        waitForSecond(second);
        FAIL() << "it has no line";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no colon was found"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(second.other());
    const SecondStudy::Load endless = [](Progress& progress) -> OpenScene {
        test::waitFor([&] { return progress.report(0.5, "reading"), false; });
        return {};
    };
    second.open(first, endless);
    second.cancel();
    EXPECT_THROW(waitForSecond(second), Cancelled);
    // Another file: the first ends without a notice, and the second begins after it.
    second.open(first, endless);
    second.close();
    EXPECT_NO_THROW(waitForSecond(second));
    second.open(first, endless);
    second.open(first, [](Progress&) { return *straightLine(2, 0); });
    EXPECT_TRUE(waitForSecond(second));
}

// The last one asked for is there in the end, whatever the late others do: finish though they were cancelled,
// or fail.
TEST(SecondStudy, TheOneAskedForLastIsThere) {
    for (const bool fails : {false, true}) {
        SCOPED_TRACE(fails);
        const auto first = straightLine(1, 0), late = straightLine(2, 0), wanted = straightLine(3, 0);
        test::Gate gate;
        SecondStudy second([] {});
        second.open(first, [&](Progress&) {
            gate.pass();
            if (fails) throw Error("late.nrrd", "", "is cut off", "copy it again");
            return *late;
        });
        gate.await();
        second.open(first, [&](Progress&) { return *late; });
        second.open(first, [&](Progress&) { return *wanted; });
        gate.open();
        ASSERT_TRUE(waitForSecond(second));
        EXPECT_EQ(second.other()->scene, wanted->scene);
        EXPECT_FALSE(second.loading());
    }
}

// Closed, or cancelled, while one is loaded and another one waits for its end: neither is there.
TEST(SecondStudy, NothingComesAfterItWasGivenUp) {
    for (const bool closed : {false, true}) {
        SCOPED_TRACE(closed);
        const auto first = straightLine(1, 0), late = straightLine(2, 0);
        test::Gate gate;
        std::atomic<bool> began = false;
        SecondStudy second([] {});
        second.open(first, [&](Progress&) {
            gate.pass();
            return *late;
        });
        gate.await();
        second.open(first, [&](Progress&) {
            began = true;
            return *late;
        });
        closed ? second.close() : second.cancel();
        gate.open();
        EXPECT_FALSE(waitForSecond(second));
        EXPECT_FALSE(second.other());
        EXPECT_FALSE(second.loading());
        EXPECT_FALSE(began);
        second.open(first, [&](Progress&) { return *late; });
        EXPECT_TRUE(waitForSecond(second)) << "asked for again it comes";
    }
}

TEST(SecondStudy, WhatWasCancelledAtItsEndIsNotThere) {
    const auto first = straightLine(1, 0), late = straightLine(2, 0);
    test::Gate gate;
    SecondStudy second([] {});
    second.open(first, [&](Progress&) {
        gate.pass();
        return *late;
    });
    gate.await();
    second.cancel();
    gate.open();
    EXPECT_THROW(waitForSecond(second), Cancelled);
    EXPECT_FALSE(second.other());
}

// The last of the places asked for while one is drawn is drawn after it, the ones between are not, and no
// picture of the study before is shown after a swap or once it is closed.
TEST(SecondStudy, PicturesAreOfTheNewestPlaceOfTheStudyThatIsThere) {
    const PackedColor red = packColor({1, 0, 0}), blue = packColor({0, 0, 1});
    const auto first = straightLine(1, red), other = straightLine(2, blue);
    SecondStudy second([] {});
    second.open(first, [&](Progress&) { return *other; });
    ASSERT_TRUE(waitForSecond(second));
    const auto placeAt = [](double along) { return SecondPlace{along, 2, false}; };
    for (int n = 1; n <= 50; ++n) second.look(placeAt(0.01 * n), {8, 8});
    ASSERT_TRUE(test::waitFor([&] { return second.picture() && second.picture()->of == placeAt(0.5); }));
    EXPECT_EQ(second.picture()->color.at(3, 3), blue);
    const auto flown = second.swap(first);
    EXPECT_FALSE(second.picture()) << "that one is flown now";
    second.look(placeAt(0.5), {8, 8});
    ASSERT_TRUE(test::waitFor([&] { return second.picture() != nullptr; })) << "the same place of another";
    EXPECT_EQ(second.picture()->color.at(3, 3), red);
    second.close();
    EXPECT_FALSE(second.picture());
    EXPECT_FALSE(second.drawing());
    EXPECT_FALSE(second.matching(*flown->scene, Pose{}));
}

// There and back while a picture is drawn: the place between is not drawn any more.
TEST(SecondStudy, APlaceThatWasLeftAgainIsNotDrawn) {
    const auto first = straightLine(1, 0), other = straightLine(2, 0);
    test::Gate gate;
    std::mutex guard;
    std::vector<double> drawn;
    dynamic_cast<StraightLine&>(*other->scene).renderer().drawn = [&](double x) {
        {
            const std::lock_guard lock(guard);
            drawn.push_back(x);
        }
        gate.pass();
    };
    SecondStudy second([] {});
    second.open(first, [&](Progress&) { return *other; });
    ASSERT_TRUE(waitForSecond(second));
    const auto lookAt = [&](double along) { second.look({along, 2, false}, {8, 8}); };
    lookAt(0.5);
    gate.await();
    lookAt(0.7);
    lookAt(0.5);
    gate.open();
    ASSERT_TRUE(test::waitFor([&] { return second.picture() != nullptr; }));
    lookAt(0.9);
    ASSERT_TRUE(test::waitFor([&] { return second.picture()->of.along == 0.9; }));
    const std::lock_guard lock(guard);
    EXPECT_EQ(std::count(drawn.begin(), drawn.end(), 0.7), 0);
    EXPECT_EQ(drawn.front(), 0.5);
    EXPECT_EQ(drawn.back(), 0.9);
}

// Swapped twice everything is as before: the match, too.
TEST(SecondStudy, SwappedTwiceIsAsBefore) {
    const auto first = straightLine(1, 0), other = straightLine(2, 0);
    SecondStudy second([] {});
    second.open(first, [&](Progress&) { return *other; });
    ASSERT_TRUE(waitForSecond(second));
    const Pose eye = poseFromAngles({0.3, 0, 0}, 1.5, 0, 0);
    const auto before = second.matching(*first->scene, eye);
    EXPECT_EQ(second.swap(first)->scene, other->scene);
    EXPECT_EQ(second.swap(other)->scene, first->scene);
    const auto after = second.matching(*first->scene, eye);
    ASSERT_TRUE(before && after);
    EXPECT_EQ(*before, *after);
    // Another study that is opened after a swap is matched from the flown one's line.
    second.swap(first);
    const auto third = straightLine(4, 0);
    second.open(other, [&](Progress&) { return *third; });
    ASSERT_TRUE(waitForSecond(second));
    EXPECT_NEAR(second.matching(*other->scene, eye)->along, 0.6, 1e-12);
}

}  // namespace
}  // namespace stereonav
