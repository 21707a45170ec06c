// Options that would change nothing are refused with the way out, and those that a command can not use are
// not offered.
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Words = std::vector<std::string>;

class NoEffect : public VolumeTest {
protected:
    // `option` is the option with its value, `words` are in the message beside its name.
    void expectUseless(Words arguments, const Words& option, Words words) const {
        arguments.insert(arguments.end(), option.begin(), option.end());
        words.push_back(option.front());
        expectRefused(arguments, words);
    }
};

TEST_F(NoEffect, AMeshIsOfTheGroundAlone) {
    for (const Words& option : {Words{"--fov", "40"},
                                {"--separation", "1"},
                                {"--zero-parallax", "9"},
                                {"--light", "auto"},
                                {"--sky", "a.png"},
                                {"--simd", "plain"},
                                {"--series", "1"},
                                {"--label", "1"},
                                {"--seed", "1,2,3"},
                                {"--resample"},
                                {"--mask-smoothing", "1"},
                                {"--isosurface"},
                                {"--isovalue", "3"},
                                {"--transfer", "wall_95"},
                                {"--opacity", "0.5"},
                                {"--backwards"},
                                {"--no-cache"},
                                {"--ambient", "3"},
                                {"--modulate", "variance"},
                                {"--shading", "lamp"},
                                {"--exposure", "2"},
                                {"--turn", "20"},
                                {"--tilt", "20"},
                                {"--up", "x"}})
        expectUseless({"mesh", hills(), "--out", "a.glb"}, option, {"mesh --help"});
    const std::string help = run({"mesh", "--help"}).out;
    for (const char* word : {"--vertical-scale", "--open-holes", "--image", "--sun", "--error"})
        EXPECT_NE(help.find(word), std::string::npos) << word;
}

TEST_F(NoEffect, ACentrelineIsOfTheStudyAlone) {
    for (const Words& option : {Words{"--fov", "40"},       {"--separation", "1"}, {"--zero-parallax", "9"},
                                {"--light", "lazy"},        {"--sky", "a.png"},    {"--simd", "plain"},
                                {"--image", "a.png"},       {"--sun", "1,2"},      {"--vertical-scale", "2"},
                                {"--open-holes"},           {"--isosurface"},      {"--isovalue", "3"},
                                {"--transfer", "wall_95"},  {"--opacity", "0.5"},  {"--ambient", "3"},
                                {"--modulate", "variance"}, {"--shading", "lamp"}, {"--exposure", "2"},
                                {"--turn", "20"},           {"--tilt", "20"},      {"--up", "x"}})
        expectUseless({"centreline", maskedTube(), "--out", "a.txt"}, option, {"centreline --help"});
    const std::string help = run({"centreline", "--help"}).out;
    for (const char* word : {"--series", "--label", "--seed", "--resample", "--backwards", "--no-cache"})
        EXPECT_NE(help.find(word), std::string::npos) << word;
}

TEST_F(NoEffect, ASeriesIsChosenInAFolderOfSlices) {
    for (const std::string command : {"info", "render"}) {
        Words arguments{command, maskedTube()};
        if (command == "render") arguments.insert(arguments.end(), {"--out", "a.png"});
        for (const char* cache : {"", "--no-cache"}) {
            Words all = arguments;
            if (*cache) all.push_back(cache);
            expectUseless(all, {"--series", "9"}, {"tube.nrrd", "folder of DICOM slices", "leave it out"});
        }
    }
    expectUseless({"render", ball(), "--isosurface", "--out", "a.png"}, {"--series", "1"}, {"ball.nrrd"});
}

TEST_F(NoEffect, GreyValuesAreNotSmoothedAsAMask) {
    for (const char* length : {"0", "2"})
        expectUseless({"render", ball(), "--isosurface", "--out", "a.png"}, {"--mask-smoothing", length},
                      {"needs a mask", "leave it out"});
}

TEST_F(NoEffect, WhereNoColonIsLookedForThereAreNoSeedsAndNoWayBack) {
    for (const Words& option : {Words{"--seed", "1,2,3"}, {"--backwards"}}) {
        expectUseless({"render", ball(), "--out", "a.png"}, option, {"shown from outside", "leave it out"});
        expectUseless({"render", ball(), "--isosurface", "--out", "a.png"}, option, {"--isosurface"});
    }
}

TEST_F(NoEffect, TwoSeparationsInACompare) {
    expectUseless({"compare", hills(), "--relative-separation", "1/30"}, {"--separation", "2"},
                  {"--relative-separation", "leave one of them out"});
}

TEST_F(NoEffect, WhatAFlightLeavesUnused) {
    expectUseless({"play", hills(), "--frames", "3", "--out", "frames"}, {"--fps", "10"}, {"--frames"});
    expectUseless({"play", hills(), "--frames", "3", "--hash"}, {"--fps", "10"}, {"--frames"});
    expectUseless({"play", hills(), "--frames", "3", "--hash"}, {"--mode", "arcd"}, {"--hash"});
    EXPECT_EQ(
        run({"play", hills(), "--size", "32x24", "--frames", "3", "--fps", "10", "--video", "a.avi"}).status,
        0);
}

TEST_F(NoEffect, OpennessOfATerrainHasNoBounces) {
    for (const Words& option :
         {Words{"--samples", "64"}, {"--order", "3"}, {"--bounces", "1"}, {"--albedo", "0.5"}})
        expectUseless({"bake", hills(), "--what", "openness", "--out", "a.light"}, option,
                      {"openness", "transfer"});
}

TEST_F(NoEffect, ExposureOfOpenness) {
    const std::string baked = (mFolder / "open.bake").string();
    ASSERT_EQ(run({"bake", ball(), "--isosurface", "--what", "openness", "--samples", "1", "--resolution",
                   "0.5", "--out", baked})
                  .status,
              0);
    expectUseless({"render", ball(), "--isosurface", "--light", baked, "--size", "32x24", "--out", "a.png"},
                  {"--exposure", "2"}, {"openness", "leave it out"});
}

TEST_F(NoEffect, WhatAModelOfAMediumLeavesOut) {
    const auto refused = [&](const char* model, const Words& option) {
        expectUseless({"render", "wax", "--model", model, "--size", "32x24", "--out", "a.png"}, option,
                      {model, "another --model"});
    };
    for (const char* model : {"emission", "surface", "direct"}) refused(model, {"--cone", "20"});
    for (const char* model : {"emission", "surface"}) refused(model, {"--phase", "droplets"});
    refused("emission", {"--light-color", "0.5"});
    EXPECT_EQ(run({"render", "wax", "--model", "direct", "--phase", "droplets", "--slices", "20", "--size",
                   "32x24", "--out", "a.png"})
                  .status,
              0);
}

TEST_F(NoEffect, ColoursUnderAnotherMedium) {
    const std::string picture = input("a.png", "not read");
    expectUseless({"render", hills(), "--medium", "snow", "--out", "b.png"}, {"--image", picture},
                  {"ground"});
    expectUseless({"render", hills(), "--medium", "snow", "--light-from", "90,30", "--out", "b.png"},
                  {"--sun", "90,30"}, {"--light-from"});
    expectUseless({"render", "cloud", "--out", "b.png"}, {"--no-cache"}, {"built in"});
}

}  // namespace
}  // namespace stereonav::test
