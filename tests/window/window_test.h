// Runs the program in a window under Xvfb, driven by a script, and compares the pictures that it saves.
// Needs xvfb-run and xdotool.
#pragma once

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "engine/base/file.h"
#include "engine/image/image_file.h"

namespace stereonav {

using Picture = Plane<PackedColor>;

inline bool installed(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

inline int byteOf(PackedColor c, int channel) {
    return srgbByteFromPacked()[c >> (10 * channel) & 1023];
}

// Mean absolute difference of sRGB bytes over two rectangles of the same size.
inline double difference(const Picture& a, int ax, int ay, const Picture& b, int bx, int by, int width,
                         int height) {
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = 0; k < 3; ++k)
                sum += std::abs(byteOf(a.at(ax + x, ay + y), k) - byteOf(b.at(bx + x, by + y), k));
    return sum / (3.0 * width * height);
}

inline double difference(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.width(), b.width());
    EXPECT_EQ(a.height(), b.height());
    if (a.width() != b.width() || a.height() != b.height()) return 0;
    return difference(a, 0, 0, b, 0, 0, a.width(), a.height());
}

// Means below kSame are rounding; above kDifferent the pictures show different things.
constexpr double kSame = 0.5, kDifferent = 1.5;

class WindowTest : public testing::Test {
protected:
    void SetUp() override {
        for (const char* program : {"xvfb-run", "xdotool"})
            if (!installed(program)) GTEST_SKIP() << program << " is not installed";
        mFolder = std::filesystem::path(testing::TempDir()) / ("stereonav_view_" + std::to_string(getpid()));
        std::filesystem::create_directories(mFolder);
    }
    void TearDown() override {
        if (!HasFailure()) std::filesystem::remove_all(mFolder);
    }

    // arguments: after the program and the folder, quoted for the shell.
    int drive(const std::string& script, const std::string& arguments = "") {
        // From a number of this process's own on: xvfb-run's way of finding a free display is a race.
        const std::string display = std::to_string(200 + getpid() % 30000);
        const std::string command = "HOME='" + mFolder.string() + "' XDG_CACHE_HOME='" + mFolder.string() +
                                    "/cache' xvfb-run -a -n " + display +
                                    " -s '-noreset -screen 0 1280x1024x24' "
                                    "'" STEREONAV_SOURCE_DIR "/tests/display/" +
                                    script + "' '" STEREONAV_PROGRAM "' '" + mFolder.string() + "' " +
                                    arguments;
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string textOf(const std::string& name) const {
        return std::filesystem::exists(mFolder / name) ? readTextFile(mFolder / name) : "";
    }
    std::map<std::string, std::filesystem::path> steps() const {
        std::map<std::string, std::filesystem::path> steps;
        std::ifstream in(mFolder / "steps.txt");
        for (std::string step, file; in >> step >> file;) steps[step] = file;
        return steps;
    }

    std::filesystem::path mFolder;
};

}  // namespace stereonav
