// Both eyes are treated alike: labels that meet in either, pictures that rest, and pictures that are shown
// from elsewhere. Each is tried where it shows only in the right eye, and only in the left one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "app/output/place_labels.h"
#include "app/view/frame_views.h"
#include "app/view/late_view.h"
#include "engine/late/late_guard.h"

namespace stereonav {
namespace {

constexpr int kBothAcross = 320, kBothDown = 200;
constexpr double kTextMargin = 3, kLetterAcross = 6, kLetterDown = 12;

FrameRequest bothEyes() {
    FrameRequest request;
    request.pose = poseFromAngles({10, -20, 300}, 0.7, -0.2, 0.05);
    request.lens.width = kBothAcross;
    request.lens.height = kBothDown;
    request.stereo = {2, 60};
    return request;
}

glm::dvec2 textSize(const std::string& text) {
    return {kLetterAcross * static_cast<double>(text.size()), kLetterDown};
}

class LabelsOfBothEyes : public testing::Test {
protected:
    LabelledPlace placeAt(const std::string& name, double x, double y, double depth) const {
        return {name, mViews.left.pointAt(x, y, depth)};
    }
    std::vector<PlaceLabel> labelsOf(const std::vector<LabelledPlace>& places) const {
        return labelsInView(mViews, mSky, places, textSize, kTextMargin);
    }
    // Returns the text and the margin around it: left, top, right, bottom.
    static std::array<double, 4> boxOf(const PlaceLabel& label, bool right) {
        const glm::dvec2 at = (right ? label.mark.right : label.mark.left) + label.textAt;
        const glm::dvec2 size = textSize(label.text);
        return {at.x - kTextMargin, at.y - kTextMargin, at.x + size.x + kTextMargin,
                at.y + size.y + kTextMargin};
    }
    static bool meet(const PlaceLabel& a, const PlaceLabel& b, bool right) {
        const auto one = boxOf(a, right), other = boxOf(b, right);
        return std::max(one[0], other[0]) < std::min(one[2], other[2]) &&
               std::max(one[1], other[1]) < std::min(one[3], other[3]);
    }
    // Returns how two labels would overlap in each eye if they were alone.
    std::array<bool, 2> wouldMeet(const LabelledPlace& a, const LabelledPlace& b) const {
        const auto one = labelsOf({a}), other = labelsOf({b});
        EXPECT_EQ(one.size(), 1u);
        EXPECT_EQ(other.size(), 1u);
        return {meet(one[0], other[0], false), meet(one[0], other[0], true)};
    }

    StereoViews mViews = viewsOf(bothEyes());
    Plane<float> mSky = [] {
        Plane<float> sky(kBothAcross, kBothDown);
        for (int y = 0; y < kBothDown; ++y)
            for (int x = 0; x < kBothAcross; ++x) sky.at(x, y) = kMissDepth;
        return sky;
    }();
};

// The near label moves to the left from the left eye to the right one, the far one to the right.
TEST_F(LabelsOfBothEyes, NoneLiesOverAnotherInEitherEye) {
    const LabelledPlace far = placeAt("far", 160, 100, 5000);
    struct Case {
        const char* name;
        double x;  // x of the near label
        std::array<bool, 2> meets;
    };
    for (const Case& one : {Case{"in the right eye alone", 194, {false, true}},
                            {"in the left eye alone", 140, {true, false}},
                            {"in both", 167, {true, true}},
                            {"in none", 212, {false, false}},
                            {"in none, on the other side", 122, {false, false}}}) {
        SCOPED_TRACE(one.name);
        const LabelledPlace near = placeAt("nigh", one.x, 100, 30);
        ASSERT_EQ(wouldMeet(near, far), one.meets);
        const bool any = one.meets[0] || one.meets[1];
        for (const auto& places : {std::vector{far, near}, std::vector{near, far}}) {
            const auto labels = labelsOf(places);
            ASSERT_EQ(labels.size(), any ? 1u : 2u);
            EXPECT_EQ(labels[0].text, "nigh") << "the nearer one stays";
        }
    }
}

// Many places at once, against the rule as it reads: nearest first, each unless it meets one before it in
// either eye.
TEST_F(LabelsOfBothEyes, AreAsTheRuleSays) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> across(5, kBothAcross - 5), down(5, kBothDown - 5),
        logDepth(std::log(25.0), std::log(1e4));
    std::array<int, 2> inOneAlone{};
    for (int turn = 0; turn < 150; ++turn) {
        std::vector<LabelledPlace> places;
        for (int n = 0; n < 25; ++n)
            places.push_back(placeAt(std::string(1 + random() % 9, static_cast<char>('a' + n)),
                                     across(random), down(random), std::exp(logDepth(random))));
        struct Alone {
            double depth;
            PlaceLabel label;
        };
        std::vector<Alone> alone;
        for (const LabelledPlace& place : places)
            if (const auto label = labelsOf({place}); !label.empty())
                alone.push_back({mViews.left.project(place.world).z, label[0]});
        std::sort(alone.begin(), alone.end(),
                  [](const Alone& a, const Alone& b) { return a.depth < b.depth; });
        std::vector<PlaceLabel> wanted;
        for (const Alone& one : alone) {
            std::array<bool, 2> meets{};
            for (const PlaceLabel& before : wanted)
                for (const bool right : {false, true})
                    meets[right] = meets[right] || meet(one.label, before, right);
            if (!meets[0] && !meets[1]) wanted.push_back(one.label);
            if (meets[0] != meets[1]) ++inOneAlone[meets[1]];
        }
        const auto labels = labelsOf(places);
        ASSERT_EQ(labels.size(), wanted.size()) << turn;
        for (std::size_t n = 0; n < labels.size(); ++n) {
            ASSERT_EQ(labels[n].text, wanted[n].text) << turn;
            ASSERT_EQ(labels[n].textAt, wanted[n].textAt) << turn;
            for (const bool right : {false, true}) {
                const auto box = boxOf(labels[n], right);
                ASSERT_GE(box[0], -1e-9) << "outside " << right;
                ASSERT_LE(box[2], kBothAcross + 1e-9) << "outside " << right;
            }
        }
    }
    EXPECT_GT(inOneAlone[0], 50) << "left";
    EXPECT_GT(inOneAlone[1], 50) << "right";
}

// A place that only one eye has in its picture has no label, on either side.
TEST_F(LabelsOfBothEyes, AreOfPlacesThatBothEyesSee) {
    const auto far = [&](double x) { return placeAt("x", x, 100, 1e6); };  // 7.9 pixels to the right
    const auto near = [&](double x) { return placeAt("x", x, 100, 35); };  // 5.6 to the left
    EXPECT_EQ(labelsOf({far(300)}).size(), 1u);
    EXPECT_TRUE(labelsOf({far(kBothAcross - 4)}).empty()) << "beyond the right eye's picture";
    EXPECT_EQ(labelsOf({near(20)}).size(), 1u);
    EXPECT_TRUE(labelsOf({near(3)}).empty()) << "beyond the right eye's picture";
    EXPECT_TRUE(labelsOf({far(-4)}).empty()) << "beyond the left eye's picture";
    EXPECT_TRUE(labelsOf({near(kBothAcross + 3)}).empty()) << "beyond the left eye's picture";
}

// --- pictures from elsewhere

EyeImage wallAt(int width, int height, float depth, PackedColor color) {
    EyeImage image;
    image.resize(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            image.viewDepth.at(x, y) = depth;
            image.color.at(x, y) = color + static_cast<PackedColor>(x);
        }
    return image;
}

// Returns walls at two depths, one for each eye, as a frame that was prepared for the late warp.
std::unique_ptr<ViewFrame> twoWalls(float left, float right) {
    auto frame = std::make_unique<ViewFrame>();
    frame->request = bothEyes();
    frame->request.late = true;
    const StereoViews views = viewsOf(frame->request);
    frame->left = wallAt(kBothAcross, kBothDown, left, 100);
    frame->right = wallAt(kBothAcross, kBothDown, right, 500);
    frame->late[0].prepare(frame->left.viewDepth, views.left);
    frame->late[1].prepare(frame->right.viewDepth, views.right);
    return frame;
}

// The eye whose wall is near sees beyond it, whichever of the two it is.
TEST(LateOfBothEyes, WhatIsSeenBeyondIsThatOfEitherEye) {
    FrameRequest now = bothEyes();
    now.pose.position += 1.5 * now.pose.right();
    const StereoViews views = viewsOf(now);
    const auto near = twoWalls(10, 10);
    const double most = LateView::seenBeyond(*near, now).x;
    EXPECT_GT(most, 0.05);
    EXPECT_LT(LateView::seenBeyond(*twoWalls(4000, 4000), now).x, 0.01);
    for (const auto& frame : {twoWalls(10, 4000), twoWalls(4000, 10)}) {
        EXPECT_NEAR(LateView::seenBeyond(*frame, now).x, most, 0.01);
        EXPECT_EQ(LateView::seenBeyond(*frame, now),
                  glm::max(seenBeyond(frame->late[0], glm::ivec2(0), views.left),
                           seenBeyond(frame->late[1], glm::ivec2(0), views.right)));
    }
    for (const auto& frame : {twoWalls(10, 4000), twoWalls(4000, 10)})
        EXPECT_LT(LateView::seenBeyond(*frame, bothEyes()).x, 1e-4) << "from where it was cast";
}

// Each eye's picture moves by the depth of its own wall: columns encode where they come from.
TEST(LateOfBothEyes, EachIsWarpedByItsOwnDepths) {
    FrameRequest now = bothEyes();
    now.pose.position += 0.5 * now.pose.right();
    const double focal = kBothDown / (2 * std::tan(0.5 * now.lens.verticalFov));
    for (const auto& depths : {std::array{20.0f, 4000.0f}, {4000.0f, 20.0f}, {40.0f, 20.0f}}) {
        const auto frame = twoWalls(depths[0], depths[1]);
        ASSERT_TRUE(LateView::fits(*frame, now));
        LateView late;
        const auto eyes = late.warp(*frame, now);
        for (const std::size_t eye : {0u, 1u}) {
            const double moved = focal * 0.5 / depths[eye];
            const PackedColor first = eye == 0 ? 100 : 500;
            for (int x = 20; x < kBothAcross - 20; ++x)
                ASSERT_NEAR(static_cast<double>((*eyes)[eye].at(x, 100)), first + x + moved, 0.6)
                    << eye << " " << x;
        }
    }
}

// A frame of one eye has no second, and a frame whose second eye is not prepared does not fit two.
TEST(LateOfBothEyes, FitsOnlyWhereBothAreThere) {
    const auto frame = twoWalls(20, 20);
    EXPECT_TRUE(LateView::fits(*frame, bothEyes()));
    for (const std::size_t eye : {0u, 1u}) {
        const auto lacks = twoWalls(20, 20);
        lacks->late[eye].forget();
        EXPECT_FALSE(LateView::fits(*lacks, bothEyes())) << eye;
    }
    FrameRequest one = bothEyes();
    one.twoEyes = false;
    const auto single = twoWalls(20, 20);
    single->request.twoEyes = false;
    single->late[1].forget();
    EXPECT_TRUE(LateView::fits(*single, one));
    LateView late;
    EXPECT_TRUE((*late.warp(*single, one))[1].empty());
}

}  // namespace
}  // namespace stereonav
