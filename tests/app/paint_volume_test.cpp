// --paint on a colon's wall, as a user runs it.
#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class VolumePaint : public VolumeTest {
protected:
    Plane<PackedColor> rendered(const std::string& name, std::vector<std::string> more) const {
        std::vector<std::string> arguments{"render", maskedTube(), "--no-cache", "--size",
                                           "96x96",  "--out",      name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return readColorImage(place() / name);
    }
};

// From the middle: the flight comes from one end and looks at the other, so one way shows one end alone.
TEST_F(VolumePaint, PaintsWhatAFlightDidNotShow) {
    std::vector<int> one, both;
    for (const char* pose : {"0,0,0,0,-90,0", "0,0,0,0,90,0"}) {
        const Plane<PackedColor> plain = rendered("plain.png", {"--pose", pose}),
                                 painted = rendered("one.png", {"--pose", pose, "--paint", "coverage"}),
                                 there = rendered("both.png", {"--pose", pose, "--paint", "coverage:both"});
        ASSERT_EQ(plain.width(), painted.width());
        one.push_back(0), both.push_back(0);
        for (int y = 0; y < plain.height(); ++y)
            for (int x = 0; x < plain.width(); ++x) {
                one.back() += plain.at(x, y) != painted.at(x, y);
                both.back() += plain.at(x, y) != there.at(x, y);
            }
    }
    const int pixels = 2 * 96 * 96;
    EXPECT_GT(std::max(one[0], one[1]), pixels / 20) << "the end that it came from";
    EXPECT_LT(std::min(one[0], one[1]), pixels / 100) << "the end that it looked at";
    EXPECT_LT(both[0] + both[1], (one[0] + one[1]) / 2) << "there and back";
}

TEST_F(VolumePaint, RefusesWhatCannotBePainted) {
    const std::string study = maskedTube();
    expectRefused({"render", study, "--out", "a.png", "--paint", "rainbow"}, {"--paint", "coverage"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "coverage:flight"},
                  {"--paint", "coverage:both"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "fluid"}, {"--paint", "coverage"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "coverage", "--isosurface"},
                  {"--isosurface"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "coverage", "--opacity", "0.9"},
                  {"translucent"});
    expectRefused({"render", study, "--no-cache", "--out", "a.png", "--paint", "coverage:none.path"},
                  {"none.path"});
}

}  // namespace
}  // namespace stereonav::test
