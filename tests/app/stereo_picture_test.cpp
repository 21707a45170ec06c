// render into files for 3D viewers, and what can not be meant by them.
#include <cstdio>

#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class StereoPicture : public VolumeTest {};

std::vector<unsigned char> unsignedBytes(const std::string& text) {
    return {text.begin(), text.end()};
}

double differenceOf(const Plane<PackedColor>& a, const Plane<PackedColor>& b, int fromX) {
    double sum = 0;
    for (int y = 0; y < b.height(); ++y)
        for (int x = 0; x < b.width(); ++x)
            sum += std::abs(static_cast<double>(a.at(fromX + x, y) >> 10 & 1023u) -
                            static_cast<double>(b.at(x, y) >> 10 & 1023u));
    return sum / b.width() / b.height();
}

TEST_F(StereoPicture, BothEyesAreInTheFileEachInItsPlace) {
    const std::vector<std::string> render{"render",       hills(), "--size", "80x60",
                                          "--separation", "60",    "--out"};
    const auto made = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = render;
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    };
    made({"l.png", "--mode", "ml"});
    made({"r.png", "--mode", "mr"});
    const auto left = readColorImage(place() / "l.png"), right = readColorImage(place() / "r.png");
    ASSERT_GT(differenceOf(left, right, 0), 15) << "the eyes look alike: nothing is tried here";

    EXPECT_NE(made({"a.jps"}).out.find("a.jps: 160x60"), std::string::npos);
    const auto jps = decodeColorImage(unsignedBytes(contentOf(place() / "a.jps")), "a.jps", "");
    ASSERT_EQ(jps.width(), 160);
    EXPECT_LT(differenceOf(jps, right, 0), 12);
    EXPECT_LT(differenceOf(jps, left, 80), 12);
    EXPECT_NE(contentOf(place() / "a.jps").find("_JPSJPS_"), std::string::npos);
    const std::string same = contentOf(place() / "a.jps");
    made({"a.jps", "--mode", "cross-eyed"});
    EXPECT_TRUE(contentOf(place() / "a.jps") == same);

    EXPECT_NE(made({"a.MPO"}).out.find("a.MPO: 2 of 80x60"), std::string::npos);
    const std::string mpo = contentOf(place() / "a.MPO");
    const std::size_t second = mpo.find("\xFF\xD8\xFF\xE1", 4);
    ASSERT_NE(second, std::string::npos);
    const auto mpoLeft = decodeColorImage(unsignedBytes(mpo.substr(0, second)), "a.mpo", "left"),
               mpoRight = decodeColorImage(unsignedBytes(mpo.substr(second)), "a.mpo", "right");
    EXPECT_LT(differenceOf(mpoLeft, left, 0), 12);
    EXPECT_LT(differenceOf(mpoRight, right, 0), 12);

    // Another program's reading.
    std::FILE* pipe =
        popen(("identify -format %wx%h jpeg:'" + (place() / "a.jps").string() + "'").c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    char said[64] = {};
    EXPECT_NE(std::fgets(said, sizeof said, pipe), nullptr);
    EXPECT_EQ(pclose(pipe), 0);
    EXPECT_STREQ(said, "160x60");
}

TEST_F(StereoPicture, OtherModesAreRefused) {
    const std::string scene = hills();
    expectRefused({"render", scene, "--mode", "sbsl", "--out", "a.jps"},
                  {"--mode", "sbsl", "a.jps", "the right eye on the left"});
    expectRefused({"render", scene, "--mode", "ml", "--out", "a.mpo"},
                  {"--mode", "ml", "a.mpo", "each eye as a picture of its own"});
    expectRefused({"render", scene, "--out", "none/a.mpo"}, {"--out", "no folder \"none\""});
    expectRefused({"compare", scene, "--frames", "1", "--plot", "a.jps"}, {"--plot", "extension"});
}

}  // namespace
}  // namespace stereonav::test
