// Marks over the picture: both eyes see them at the point in space that they mark, and no mark leaves the
// picture.
#include "app/output/eye_marks.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/output/place_labels.h"
#include "app/view/frame_views.h"

namespace stereonav {
namespace {

constexpr int kMarkedAcross = 320, kMarkedDown = 200;
constexpr float kMarkedSky = kMissDepth;

FrameRequest request(const StereoSetting& eyes = {2, 60}) {
    FrameRequest request;
    request.pose = poseFromAngles({10, -20, 300}, 0.7, -0.2, 0.05);
    request.lens.width = kMarkedAcross;
    request.lens.height = kMarkedDown;
    request.stereo = eyes;
    return request;
}

Plane<float> everywhere(float depth) {
    Plane<float> plane(kMarkedAcross, kMarkedDown);
    for (int y = 0; y < kMarkedDown; ++y)
        for (int x = 0; x < kMarkedAcross; ++x) plane.at(x, y) = depth;
    return plane;
}

void expectNear(const glm::dvec2& a, const glm::dvec2& b) {
    EXPECT_NEAR(a.x, b.x, 0.1);
    EXPECT_NEAR(a.y, b.y, 0.1);
}

// Over a round Earth a pixel 60 km away shows ground that lies 246 m higher than it is seen.
TEST(EyeMarks, AreOfTheGroundItself) {
    FrameRequest far = request();
    far.lens.fall = 6.8e-8;
    const StereoViews views = viewsOf(far);
    const Plane<float> seen = everywhere(6e4f);
    const auto world = worldUnder(views, seen, glm::dvec2(0.5));
    ASSERT_TRUE(world);
    const glm::dvec3 apparent = views.left.pointAt(160.5, 100.5, 6e4);
    EXPECT_NEAR(world->x, apparent.x, 1e-6);
    EXPECT_NEAR(world->z - apparent.z, 6.8e-8 * 3.6e9 * (1 - std::pow(std::sin(0.2), 2)), 1);
    const auto mark = markOf(views, seen, *world);
    ASSERT_TRUE(mark);
    expectNear(mark->mark.left, {160.5, 100.5});
    expectNear(mark->mark.right, {views.rightColumn(160.5, 6e4), 100.5});
}

TEST(EyeMarks, LieWhereBothEyesSeeThePoint) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 0.999), logDepth(std::log(5.0), std::log(1e5));
    for (const StereoSetting& eyes :
         {StereoSetting{2, 60}, StereoSetting{0, 60}, StereoSetting{0.065, 1.9}}) {
        const StereoViews views = viewsOf(request(eyes));
        for (int n = 0; n < 200; ++n) {
            const glm::dvec2 at(share(random), share(random));
            const auto depth = static_cast<float>(std::exp(logDepth(random)));
            const Plane<float> seen = everywhere(depth);
            const EyeMark mark = markUnder(views, seen, at);
            const glm::dvec3 point =
                views.left.pointAt(at.x * kMarkedAcross, at.y * kMarkedDown, static_cast<double>(depth));
            expectNear(mark.left, glm::dvec2(views.left.project(point)));
            expectNear(mark.right, glm::dvec2(views.right.project(point)));
            const auto marked = markOf(views, seen, point);
            const bool inBoth = mark.right.x >= 0 && mark.right.x < kMarkedAcross;
            ASSERT_EQ(marked.has_value(), inBoth) << depth;
            if (!marked) continue;
            expectNear(marked->mark.left, mark.left);
            expectNear(marked->mark.right, mark.right);
            EXPECT_NEAR(marked->depth, depth, 1e-4 * depth);
        }
    }
}

// The point lies on the surface at the depth's own pixel: at most half of a larger one away.
TEST(EyeMarks, ThePointUnderAPlaceIsOnTheSurface) {
    const StereoViews views = viewsOf(request());
    const Plane<float> fine = everywhere(40);
    Plane<float> small(kMarkedAcross / 4 + 6, kMarkedDown / 4 + 4);  // with a guard of 3 and 2 pixels
    for (int y = 0; y < small.height(); ++y)
        for (int x = 0; x < small.width(); ++x) small.at(x, y) = static_cast<float>(10 + x);
    for (const glm::dvec2& at : {glm::dvec2(0.3, 0.6), glm::dvec2(0, 0), glm::dvec2(0.999, 0.999)}) {
        const auto point = worldUnder(views, fine, at);
        ASSERT_TRUE(point);
        const glm::dvec3 seen = views.left.project(*point);
        EXPECT_NEAR(seen.x, std::floor(at.x * kMarkedAcross) + 0.5, 1e-9);
        EXPECT_NEAR(seen.y, std::floor(at.y * kMarkedDown) + 0.5, 1e-9);
        EXPECT_NEAR(seen.z, 40, 1e-9);
        const auto coarse = worldUnder(views, small, at, {3, 2});
        ASSERT_TRUE(coarse);
        const glm::dvec3 near = views.left.project(*coarse);
        EXPECT_LE(std::abs(near.x - at.x * kMarkedAcross), 2 + 1e-9);
        EXPECT_LE(std::abs(near.y - at.y * kMarkedDown), 2 + 1e-9);
        EXPECT_NEAR(near.z, 13 + std::floor(at.x * kMarkedAcross / 4), 1e-5);
    }
    for (const glm::dvec2& beside : {glm::dvec2(-0.1, 0.5), glm::dvec2(0.5, 1), glm::dvec2(std::nan(""), 0)})
        EXPECT_FALSE(worldUnder(views, fine, beside));
    for (const float depth : {kMarkedSky, 0.0f, std::nanf("")})
        EXPECT_FALSE(worldUnder(views, everywhere(depth), {0.5, 0.5}));
    EXPECT_FALSE(worldUnder(views, {}, {0.5, 0.5}));
}

TEST(EyeMarks, OverWhatHasNoDepthTheyLieInTheScreen) {
    const StereoViews views = viewsOf(request());
    for (const float depth : {kMarkedSky, 0.0f, -3.0f, std::nanf("")}) {
        const EyeMark mark = markUnder(views, everywhere(depth), {0.25, 0.5});
        EXPECT_EQ(mark.left, glm::dvec2(80, 100));
        EXPECT_EQ(mark.right, mark.left) << depth;
    }
    const Plane<float> near = everywhere(60);
    EXPECT_NEAR(markUnder(views, near, {0.25, 0.5}).right.x, 80, 1e-6) << "at the distance of the screen";
    for (const glm::dvec2& beside : {glm::dvec2(-0.1, 0.5), glm::dvec2(0.5, 1), glm::dvec2(std::nan(""), 0)})
        EXPECT_EQ(markUnder(views, everywhere(10), beside).right.y,
                  markUnder(views, everywhere(10), beside).left.y)
            << "beside the picture nothing is read";
    EXPECT_EQ(markUnder(views, {}, {0.5, 0.5}).right, glm::dvec2(160, 100)) << "no picture yet";
}

TEST(EyeMarks, BehindTheEyeAndBehindTheGroundThereIsNone) {
    const FrameRequest asked = request();
    const StereoViews views = viewsOf(asked);
    const auto at = [&](double depth) { return views.left.pointAt(160, 100, depth); };
    const Plane<float> sky = everywhere(kMarkedSky);
    EXPECT_TRUE(markOf(views, sky, at(100)));
    EXPECT_FALSE(markOf(views, sky, at(-100)));
    EXPECT_FALSE(markOf(views, sky, at(0.05))) << "nearer than the eyes see";
    EXPECT_FALSE(markOf(views, sky, asked.pose.position)) << "between the eyes";
    EXPECT_FALSE(markOf(views, sky, glm::dvec3(std::nan(""), 0, 0)));
    EXPECT_FALSE(markOf(views, sky, glm::dvec3(std::numeric_limits<double>::infinity(), 0, 0)));
    EXPECT_FALSE(markOf(views, everywhere(80), at(100))) << "something is in front";
    EXPECT_TRUE(markOf(views, everywhere(99.5f), at(100))) << "it stands on the ground";
    EXPECT_TRUE(markOf(views, everywhere(0), at(100))) << "nothing is known there";
    // Marks at the border are seen by both eyes, or there is none.
    for (const double x : {0.5, kMarkedAcross - 0.5}) {
        const glm::dvec3 far = views.left.pointAt(x, 100, 1e6), screen = views.left.pointAt(x, 100, 60);
        EXPECT_TRUE(markOf(views, sky, screen)) << x;
        EXPECT_EQ(markOf(views, sky, far).has_value(), x < 100)
            << "the far one is further right for the right";
    }
}

TEST(EyeMarks, OfOneEyeHaveNoParallax) {
    FrameRequest asked = request();
    asked.twoEyes = false;
    const StereoViews views = viewsOf(asked);
    const EyeMark mark = markUnder(views, everywhere(5), {0.5, 0.25});
    EXPECT_EQ(mark.left, mark.right);
    const auto point = markOf(views, everywhere(kMarkedSky), views.left.pointAt(100, 50, 40));
    ASSERT_TRUE(point);
    EXPECT_EQ(point->mark.left, point->mark.right);
}

class PlaceLabelsTest : public testing::Test {
protected:
    void keep(const std::string& name, double x, double y, double depth) {
        mPlaces.push_back({name, viewsOf(mRequest).left.pointAt(x, y, depth)});
    }
    std::vector<PlaceLabel> labels() const {
        const auto sizeOf = [](const std::string& text) {
            return glm::dvec2(6.0 * static_cast<double>(text.size()), 12);
        };
        return labelsInView(viewsOf(mRequest), mDepth, mPlaces, sizeOf, 3);
    }
    // Expects it inside each eye's picture.
    static void expectInside(const PlaceLabel& label) {
        for (const glm::dvec2& mark : {label.mark.left, label.mark.right}) {
            const glm::dvec2 low = mark + label.textAt;
            EXPECT_GE(low.x, 0) << label.text;
            EXPECT_GE(low.y, 0) << label.text;
            EXPECT_LE(low.x + 6.0 * static_cast<double>(label.text.size()), kMarkedAcross) << label.text;
            EXPECT_LE(low.y + 12, kMarkedDown) << label.text;
        }
    }

    FrameRequest mRequest = request();
    Plane<float> mDepth = everywhere(kMarkedSky);
    std::vector<LabelledPlace> mPlaces;
};

TEST_F(PlaceLabelsTest, StayInsideBothPictures) {
    for (const double x : {14.0, 160.0, 306.0})
        for (const double y : {1.0, 60.0, 120.0, 198.0})
            for (const double depth : {30.0, 60.0, 5000.0}) {
                mPlaces.clear();
                keep("a ridge in the west", x, y, depth);
                const auto all = labels();
                ASSERT_EQ(all.size(), 1u) << x << " " << y << " " << depth;
                expectInside(all[0]);
            }
    mPlaces.clear();
    keep(std::string(200, 'x'), 160, 100, 60);
    EXPECT_TRUE(labels().empty() || labels()[0].text.size() < 40) << "a long name is cut";
    mRequest.lens.width = mRequest.lens.height = 4;
    mDepth = Plane<float>();
    EXPECT_TRUE(labels().empty()) << "no room";
}

TEST_F(PlaceLabelsTest, TheNearestComesFirstAndNoneLiesOverAnother) {
    EXPECT_TRUE(labels().empty());
    keep("far", 160, 100, 500);
    keep("near", 164, 103, 100);
    keep("aside", 60, 40, 900);
    auto all = labels();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].text, "near");
    EXPECT_EQ(all[1].text, "aside");
    keep("here", 160, 100, 5);
    all = labels();
    EXPECT_EQ(all[0].text, "near") << "one that is so far before the screen is where one is";
    mDepth = everywhere(200);
    all = labels();
    ASSERT_EQ(all.size(), 1u) << "behind the hill";
    EXPECT_EQ(all[0].text, "near");
}

TEST_F(PlaceLabelsTest, LongNamesAreCutBetweenLetters) {
    std::string name;
    for (int n = 0; n < 40; ++n) name += "\u5c71";
    keep(name, 160, 100, 60);
    const auto sizeOf = [](const std::string&) { return glm::dvec2(50, 12); };
    const auto all = labelsInView(viewsOf(mRequest), mDepth, mPlaces, sizeOf, 3);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].text, name.substr(0, std::size_t{3} * 32) + "\u2026");
}

}  // namespace
}  // namespace stereonav
