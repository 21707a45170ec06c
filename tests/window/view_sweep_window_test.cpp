// A medium in a window, swept by the shaders: the pictures are those of the processor's sweep, and where
// there is no OpenGL 4.5 the processor goes on and it is said why.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/window/window_test.h"

namespace stereonav {
namespace {

using testing::HasSubstr;
using testing::Not;

class SweepWindow : public WindowTest {
protected:
    void fly(const std::string& sweeps) {
        ASSERT_EQ(drive("drive_sweep.sh", "'" + sweeps + "' wax --slices 24 --light-size 32"), 0)
            << textOf("cpu/problems.txt") << textOf("gpu/problems.txt") << textOf("gpu/log.txt");
    }
    std::map<std::string, Picture> shotsOf(const std::string& sweep) {
        EXPECT_EQ(textOf(sweep + "/status.txt"), "0\n") << textOf(sweep + "/log.txt");
        std::map<std::string, Picture> shots;
        std::ifstream in(mFolder / sweep / "steps.txt");
        for (std::string step, file; in >> step >> file;) shots[step] = readColorImage(file);
        EXPECT_EQ(shots.size(), 2u);
        return shots;
    }
};

TEST_F(SweepWindow, ShadersAndProcessorShowTheSame) {
    ASSERT_NO_FATAL_FAILURE(fly("cpu gpu"));
    auto cpu = shotsOf("cpu"), gpu = shotsOf("gpu");
    EXPECT_THAT(textOf("cpu/log.txt"), Not(HasSubstr("GPU")));
    EXPECT_THAT(textOf("gpu/log.txt"), HasSubstr("GPU sweep\n"));
    EXPECT_THAT(textOf("gpu/log.txt"), Not(HasSubstr("swept on")));
    for (const char* step : {"indirect", "surface"}) EXPECT_LT(difference(cpu[step], gpu[step]), kSame);
    EXPECT_GT(difference(gpu["indirect"], gpu["surface"]), kDifferent);
}

TEST_F(SweepWindow, WithoutTheVersionTheProcessorGoesOn) {
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    fly("gpu");
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    shotsOf("gpu");
    EXPECT_THAT(textOf("gpu/log.txt"), HasSubstr("swept on the CPU: volume light on the GPU: "));
    EXPECT_THAT(textOf("gpu/log.txt"), Not(HasSubstr("GPU sweep")));
}

TEST_F(SweepWindow, WhatMakesNoSenseIsRefusedBeforeAWindowOpens) {
    const std::string log = (mFolder / "log.txt").string();
    for (const auto& [arguments, line] :
         {std::pair{"wax --sweep fast", "--sweep: expected auto, cpu or gpu, got \"fast\""},
          std::pair{"--sweep gpu", "--sweep: needs a medium"}}) {
        const std::string command =
            std::string("env -u DISPLAY -u WAYLAND_DISPLAY '" STEREONAV_PROGRAM "' view ") + arguments +
            " >'" + log + "' 2>&1";
        EXPECT_NE(std::system(command.c_str()), 0);
        const std::string text = textOf("log.txt");
        EXPECT_THAT(text, HasSubstr(line));
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    }
}

}  // namespace
}  // namespace stereonav
