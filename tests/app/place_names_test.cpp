// Names of places in pictures that are written: over the place's own pixel in both eyes, hidden where ground
// is before it, and none over another one.
#include "app/output/place_names.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/base/file.h"
#include "tests/app/program.h"

namespace stereonav::test {
namespace {

constexpr int kNamedAcross = 640, kNamedDown = 400;
constexpr double kNamedFov = 0.8, kNamedEyes = 2, kNamedScreen = 60;

// Looks north from the origin, x to the right and z up.
StereoViews namedViews(int width = kNamedAcross, int height = kNamedDown) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    lens.verticalFov = kNamedFov;
    return makeStereoViews(poseFromAngles(glm::dvec3(0), 0, 0, 0), lens, {kNamedEyes, kNamedScreen});
}

EyePair greyEyes(float depth = std::numeric_limits<float>::infinity(), int width = kNamedAcross,
                 int height = kNamedDown) {
    EyePair eyes;
    for (EyeImage* const eye : {&eyes.left, &eyes.right}) {
        eye->color.resize(width, height);
        eye->viewDepth.resize(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                eye->color.at(x, y) = packColor(glm::vec3(0.25f));
                eye->viewDepth.at(x, y) = depth;
            }
    }
    return eyes;
}

// What of a picture is no longer grey.
struct Changed {
    glm::ivec2 low{1 << 30}, high{-1};
    int pixels = 0;
    glm::dvec2 middle() const { return 0.5 * glm::dvec2(low + high + 1); }
};
Changed changedIn(const Plane<PackedColor>& eye) {
    Changed changed;
    for (int y = 0; y < eye.height(); ++y)
        for (int x = 0; x < eye.width(); ++x)
            if (eye.at(x, y) != packColor(glm::vec3(0.25f))) {
                changed.low = glm::min(changed.low, glm::ivec2(x, y));
                changed.high = glm::max(changed.high, glm::ivec2(x, y));
                ++changed.pixels;
            }
    return changed;
}

EyePair named(const std::vector<PaintedPlace>& places, float depth = std::numeric_limits<float>::infinity()) {
    EyePair eyes = greyEyes(depth);
    PlaceNames().draw(places, namedViews(), eyes);
    return eyes;
}

bool same(const EyePair& a, const EyePair& b) {
    for (int y = 0; y < a.left.color.height(); ++y)
        for (int x = 0; x < a.left.color.width(); ++x)
            if (a.left.color.at(x, y) != b.left.color.at(x, y) ||
                a.right.color.at(x, y) != b.right.color.at(x, y))
                return false;
    return true;
}

TEST(PlaceNames, StandOverTheirPlaceInBothEyes) {
    // Both windows coincide at the distance of the screen.
    const double focal = 0.5 * kNamedDown / std::tan(0.5 * kNamedFov);
    for (const glm::dvec3& place :
         {glm::dvec3(0, 60, 0), glm::dvec3(7, 45, -3), glm::dvec3(-300, 1500, 20), glm::dvec3(2e4, 1e5, 0)}) {
        const EyePair eyes = named({{"Summit", place}});
        const Changed seen[2] = {changedIn(eyes.left.color), changedIn(eyes.right.color)};
        const double row = 0.5 * kNamedDown - focal * place.z / place.y;
        for (int eye = 0; eye < 2; ++eye) {
            const double aside = (eye == 0 ? 0.5 : -0.5) * kNamedEyes;
            const double column =
                0.5 * kNamedAcross + focal * ((place.x + aside) / place.y - aside / kNamedScreen);
            EXPECT_NEAR(seen[eye].middle().x, column, 1) << eye << " at " << place.y;
            EXPECT_LT(seen[eye].high.y, row - 4) << "clear of the mark";
            EXPECT_GT(seen[eye].high.y, row - 12) << "and near it";
            EXPECT_EQ(seen[eye].high.y - seen[eye].low.y + 1, PlaceNames::letterHeight(kNamedDown));
        }
        // The same letters in both, so that they fuse.
        ASSERT_EQ(seen[0].pixels, seen[1].pixels);
        ASSERT_EQ(seen[0].low.y, seen[1].low.y);
        for (int y = seen[0].low.y; y <= seen[0].high.y; ++y)
            for (int x = 0; x <= seen[0].high.x - seen[0].low.x; ++x)
                ASSERT_EQ(eyes.left.color.at(seen[0].low.x + x, y),
                          eyes.right.color.at(seen[1].low.x + x, y));
    }
}

TEST(PlaceNames, AreHiddenWithTheirPlaces) {
    const PaintedPlace place{"Summit", {0, 100, 0}};
    EXPECT_EQ(changedIn(named({place}, 80).left.color).pixels, 0) << "a hill is before it";
    EXPECT_EQ(changedIn(named({place}, 80).right.color).pixels, 0);
    EXPECT_GT(changedIn(named({place}, 99.9f).right.color).pixels, 0) << "it stands on the ground";
    for (const glm::dvec3& outside : {glm::dvec3(0, -100, 0), glm::dvec3(0, 0, 0), glm::dvec3(200, 100, 0),
                                      glm::dvec3(0, 100, 90), glm::dvec3(std::nan(""), 100, 0)})
        EXPECT_EQ(changedIn(named({{"Summit", outside}}).left.color).pixels, 0) << outside.x;
}

TEST(PlaceNames, NoneLiesOverANearerOne) {
    const PaintedPlace near{"near", {0, 100, 0}}, far{"farther off", {0, 200, 0}};
    EXPECT_TRUE(same(named({far, near}), named({near})));
    EXPECT_TRUE(same(named({near, {"twice", near.world}}), named({near}))) << "the first of two on one place";
    const EyePair apart = named({near, {"beside", {30, 100, 0}}});
    EXPECT_GT(changedIn(apart.left.color).pixels, changedIn(named({near}).left.color).pixels + 100);
}

// From a near place to a far one eyes move names towards each other on one side, and apart on the other.
TEST(PlaceNames, NoneLiesOverANearerOneInEitherEye) {
    const auto besides = [](const Changed& a, const Changed& b) {
        return std::max(a.low.x, b.low.x) - std::min(a.high.x, b.high.x);  // pixels between them
    };
    const PaintedPlace near{"near by", {0, 40, 0}};
    const EyePair alone = named({near});
    const Changed left = changedIn(alone.left.color), right = changedIn(alone.right.color);
    int leftAlone = 0, rightAlone = 0;
    for (double x = -750; x <= 750; x += 15) {
        const PaintedPlace far{"far off", {x, 4000, 0}};
        const EyePair other = named({far}), both = named({far, near});
        const int apart = besides(left, changedIn(other.left.color)),
                  apartRight = besides(right, changedIn(other.right.color));
        // Between a pixel and two margins it may be either.
        const int clear = 2 + PlaceNames::letterHeight(kNamedDown);
        const bool meets = apart < 0, meetsRight = apartRight < 0;
        if (meets || meetsRight) {
            EXPECT_TRUE(same(both, alone)) << x;
        } else if (apart > clear && apartRight > clear) {
            EXPECT_GT(changedIn(both.left.color).pixels, changedIn(alone.left.color).pixels) << x;
            EXPECT_GT(changedIn(both.right.color).pixels, changedIn(alone.right.color).pixels) << x;
        }
        leftAlone += meets && apartRight > clear;
        rightAlone += meetsRight && apart > clear;
    }
    EXPECT_GT(leftAlone, 0);
    EXPECT_GT(rightAlone, 0);
}

TEST(PlaceNames, OfAnyBytesAreDrawn) {
    const glm::dvec3 here(0, 100, 0);
    const auto many = [](const std::string& letter, int times) {
        std::string text;
        for (int n = 0; n < times; ++n) text += letter;
        return text;
    };
    EXPECT_EQ(changedIn(named({{"", here}}).left.color).pixels, 0);
    EXPECT_TRUE(same(named({{many("\u00e9", 250), here}}), named({{many("\u00e9", 33), here}}))) << "cut";
    EXPECT_FALSE(same(named({{many("\u00e9", 33), here}}), named({{many("\u00e9", 32), here}})));
    std::set<int> widths;
    for (const std::string& name : {many("i", 500), many("W", 500), many("\xff", 500), many("\u4e2d", 160)}) {
        const Changed seen = changedIn(named({{name, here}}).left.color);
        EXPECT_GT(seen.pixels, 100);
        EXPECT_LT(seen.high.x - seen.low.x, 34 * PlaceNames::letterHeight(kNamedDown) * 1.1);
        widths.insert(seen.high.x - seen.low.x);
    }
    EXPECT_EQ(widths.size(), 3u) << "what the font has not is drawn as what is no letter";
}

TEST(PlaceNames, FitPicturesOfAnySize) {
    EXPECT_EQ(PlaceNames::letterHeight(720), 18);
    EXPECT_EQ(PlaceNames::letterHeight(1), Letters::kLeastHeight);
    EXPECT_EQ(PlaceNames::letterHeight(1 << 20), Letters::kMostHeight);
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 200), std::pair(200, 3)}) {
        EyePair eyes = greyEyes(std::numeric_limits<float>::infinity(), width, height);
        PlaceNames().draw({{"Summit", {0, 100, 0}}}, namedViews(width, height), eyes);
        EXPECT_EQ(changedIn(eyes.left.color).pixels, 0) << width << ": no room";
    }
    EyePair eyes = greyEyes(std::numeric_limits<float>::infinity(), 60, 40);
    PlaceNames names;
    names.draw({{"A", {0, 100, 0}}}, namedViews(60, 40), eyes);
    EXPECT_GT(changedIn(eyes.left.color).pixels, 0);
    eyes = greyEyes();
    names.draw({{"Summit", {0, 100, 0}}}, namedViews(), eyes);
    EXPECT_TRUE(same(eyes, named({{"Summit", {0, 100, 0}}}))) << "another size";
}

class NamedPlacesTest : public ProgramTest {
protected:
    std::string places(const std::string& name, double x, double y) {
        const std::string file = (place() / "places.geojson").string();
        writeTextFile(file, R"({"type":"Feature","properties":{"name":")" + name +
                                R"("},"geometry":{"type":"Point","coordinates":[)" + std::to_string(x) + "," +
                                std::to_string(y) + "]}}");
        return file;
    }
    // Looks west over a hill in the middle.
    std::string picture(const std::string& tracks, const std::string& threads = "1") {
        const std::string dem = grid("hills.asc", 60, 50, 10, [](int i, int j) {
            return std::max(0, 120 - ((i - 30) * (i - 30) + (j - 25) * (j - 25)) / 4);
        });
        const Outcome outcome = run({"render", dem, "--size", "320x180", "--pose", "280,0,60,-90,-5,0",
                                     "--tracks", tracks, "--threads", threads, "--out", "out.png"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return contentOf(place() / "out.png");
    }
};

TEST_F(NamedPlacesTest, AreInPicturesUnlessAHillHidesThem) {
    const std::string before = picture(places("Near", 120, 0));
    EXPECT_NE(before, picture(places("", 120, 0)));
    EXPECT_EQ(before, picture(places("Near", 120, 0), "3")) << "threads change nothing";
    EXPECT_EQ(picture(places("Behind", -180, 0)), picture(places("", -180, 0)));
}

TEST_F(NamedPlacesTest, AreInVideos) {
    const std::string dem = grid("flat.asc", 60, 50, 10, [](int, int) { return 5; });
    const auto hash = [&](const std::string& name) {
        std::string points;
        for (const int x : {-200, -100, 0, 100, 200})
            for (const int y : {-200, -100, 0, 100, 200})
                points += (points.empty() ? "[" : ",[") + std::to_string(x) + "," + std::to_string(y) + "]";
        const std::string file = (place() / "all.geojson").string();
        writeTextFile(file, R"({"type":"Feature","properties":{"name":")" + name +
                                R"("},"geometry":{"type":"MultiPoint","coordinates":[)" + points + "]}}");
        const Outcome outcome =
            run({"play", dem, "--size", "320x180", "--frames", "2", "--hash", "--tracks", file});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out.substr(outcome.out.find("hash "));
    };
    EXPECT_NE(hash("Here"), hash(""));
}

}  // namespace
}  // namespace stereonav::test
