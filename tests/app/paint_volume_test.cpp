// --paint on a colon's wall, as a user runs it.
#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class VolumePaint : public VolumeTest {
protected:
    // The share of pixels of a painted picture that differ from the plain one, and how far two ways of making
    // the right eye are apart.
    Plane<PackedColor> rendered(const std::string& name, std::vector<std::string> more) const {
        std::vector<std::string> arguments{"render", maskedTube(), "--no-cache", "--size",
                                           "96x96",  "--out",      name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return readColorImage(place() / name);
    }
};

TEST_F(VolumePaint, PaintsWhatAFlightDidNotShow) {
    // Backwards from the start the wall behind it is seen, which a flight one way did not show.
    const std::vector<std::string> back{"--fov", "90"};
    const Plane<PackedColor> plain = rendered("plain.png", back);
    const Plane<PackedColor> painted = rendered("painted.png", {"--fov", "90", "--paint", "coverage"});
    const Plane<PackedColor> both = rendered("both.png", {"--fov", "90", "--paint", "coverage:both"});
    ASSERT_EQ(plain.width(), painted.width());
    int one = 0, two = 0;
    for (int y = 0; y < plain.height(); ++y)
        for (int x = 0; x < plain.width(); ++x)
            one += plain.at(x, y) != painted.at(x, y), two += plain.at(x, y) != both.at(x, y);
    EXPECT_GE(one, two) << "what both ways show, one way may not";
    EXPECT_LT(two, plain.width() * plain.height() / 4);
}

TEST_F(VolumePaint, RefusesWhatCannotBePainted) {
    const std::string study = maskedTube();
    expectRefused({"render", study, "--out", "a.png", "--paint", "rainbow"}, {"--paint", "coverage"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "coverage:flight"},
                  {"--paint", "coverage:both"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "fluid:x"}, {"--paint"});
    expectRefused({"render", study, "--no-cache", "--out", "a.png", "--paint", "fluid"},
                  {"--paint fluid", "mask"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "coverage", "--isosurface"},
                  {"--isosurface"});
    expectRefused({"render", study, "--out", "a.png", "--paint", "coverage", "--opacity", "0.9"},
                  {"translucent"});
    expectRefused({"render", study, "--no-cache", "--out", "a.png", "--paint", "coverage:none.path"},
                  {"none.path"});
}

}  // namespace
}  // namespace stereonav::test
