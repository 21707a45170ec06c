// The same voxels at every spacing: a volume of nanometres is seen as one of metres is, and a mask whose
// spacing is extreme opens or is refused, however long its millimetres are.
#include <fmt/format.h>

#include "tests/app/picture_values.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class VolumeScales : public VolumeTest {
protected:
    std::string ballOf(double spacing_mm) const {
        return nrrd(fmt::format("ball_{:g}.nrrd", spacing_mm), {24, 24, 24, spacing_mm, "short", ""},
                    [](int i, int j, int k) {
                        return std::max(0.0, 1000 - 60 * std::hypot(i - 11.5, j - 11.5, k - 11.5));
                    });
    }
    std::string tubeOf(const std::string& spacings) const {
        std::string text = fmt::format(
            "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 24 24 24\nspacings: {}\nencoding: raw\n\n",
            spacings);
        for (int k = 0; k < 24; ++k)
            for (int j = 0; j < 24; ++j)
                for (int i = 0; i < 24; ++i) text += static_cast<char>(inTube(i, j, k) ? 1 : 0);
        return input("tube.nrrd", text);
    }
    Shown picture(const std::string& study) const {
        const Outcome outcome = run({"render", study, "--isosurface", "--size", "64x48", "--out", "a.png"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return readLinearImage(place() / "a.png");
    }
};

TEST_F(VolumeScales, EachIsSeenFromItsOwnDistance) {
    const Shown usual = picture(ballOf(2));
    int lit = 0;
    for (const glm::vec3& pixel : usual.pixels) lit += levels(pixel.x) > 60;
    ASSERT_GT(lit, 500) << "of 128 x 48 pixels";
    for (const double spacing : {1e-7, 1e-5, 1e-2, 1e3, 1e6})
        expectAlike(picture(ballOf(spacing)), usual, 3, fmt::format("{:g} mm", spacing).c_str());
}

TEST_F(VolumeScales, MasksOfExtremeSpacingEndInOneLine) {
    for (const char* spacings : {"1e4 0.83 1", "1e20 1 1", "1 1 1e-6", "1e-6 1 1"}) {
        const std::string study = tubeOf(spacings);
        for (const char* command : {"info", "centreline"}) {
            std::vector<std::string> words{command, study, "--no-cache"};
            if (words[0] == "centreline") words.insert(words.end(), {"--out", "a.txt"});
            expectRefused(words, {"tube.nrrd", "spacing"});
        }
    }
}

// Even ones open, or it is said why no colon is flown through.
TEST_F(VolumeScales, MasksOfEvenSpacingOpenAtAnySize) {
    for (const char* spacing : {"1e-6", "1e-3", "0.1", "10", "1e3", "1e6"}) {
        const std::string study = tubeOf(fmt::format("{0} {0} {0}", spacing));
        const Outcome inside = run({"info", study, "--no-cache", "--size", "16x12"});
        if (inside.status != 0) {
            EXPECT_NE(inside.err.find("expected a stretch with room"), std::string::npos);
        }
        EXPECT_EQ(linesIn(inside.err), inside.status) << spacing << ": " << inside.err;
        const Outcome outside = run({"render", study, "--isosurface", "--size", "16x12", "--out", "a.png"});
        EXPECT_EQ(outside.status, 0) << spacing << ": " << outside.err;
    }
    // The most uneven that it may be.
    for (const char* spacings : {"0.5 0.5 24", "45 1 1", "1 49 1"}) {
        const Outcome outcome = run({"info", tubeOf(spacings), "--no-cache", "--size", "16x12"});
        EXPECT_EQ(linesIn(outcome.err), outcome.status) << spacings << ": " << outcome.err;
    }
}

}  // namespace
}  // namespace stereonav::test
