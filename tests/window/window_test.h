// Runs the program in a window under Xvfb, driven by a script, and compares the pictures that it saves.
// Needs Xvfb and xdotool.
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
        for (const char* program : {"Xvfb", "xdotool"})
            if (!installed(program)) GTEST_SKIP() << program << " is not installed";
        std::string pattern = (std::filesystem::path(testing::TempDir()) / "stereonav_view_XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        mFolder = pattern;
    }
    void TearDown() override {
        if (!HasFailure() && !mFolder.empty()) std::filesystem::remove_all(mFolder);
    }

    // arguments: after the program and the folder, quoted for the shell.
    int drive(const std::string& script, const std::string& arguments = "") {
        const std::string scripts = STEREONAV_SOURCE_DIR "/tests/window/",
                          folder = "'" + mFolder.string() + "' ";
        const std::string command = "'" + scripts + "own_display.sh' " + folder + "'" + scripts + script +
                                    "' '" STEREONAV_PROGRAM "' " + folder + arguments;
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
