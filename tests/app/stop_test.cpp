// SIGTERM and SIGINT at any time: the run ends before it is done, says so, and leaves neither half a file nor
// a lost one.
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class Stop : public VolumeTest {
protected:
    struct Job {
        std::string name;
        std::vector<std::string> arguments;
        std::string old;       // a file in the place that holds something before; "": none
        bool keeps = false;    // what is done, as a file of its own
        bool endless = false;  // it would take many minutes on any machine
    };

    std::vector<Job> jobs() const {
        const std::string scene = ground();
        std::vector<Job> all{
            {"render",
             {"render", "wax", "--size", "2000x2000", "--slices", "65536", "--out", "a.png"},
             "a.png"},
            {"play",
             {"play", scene, "--size", "400x300", "--frames", "1000000", "--out", "frames"},
             "",
             true},
            {"video",
             {"play", scene, "--size", "400x300", "--frames", "1000000", "--video", "a.mkv"},
             "a.mkv"},
            {"video with frames ahead",
             {"play", scene, "--size", "400x300", "--frames", "1000000", "--video", "a.mp4"},
             "a.mp4"},
            {"compare",
             {"compare", scene, "--size", "600x400", "--frames", "100000", "--json", "a.json"},
             "a.json"},
            {"bake terrain",
             {"bake", scene, "--samples", "65536", "--resolution", "1", "--out", "a.light"},
             ""},
            {"bake volume",
             {"bake", maskedTube(), "--no-cache", "--samples", "16777216", "--out", "a.bake"},
             "",
             true},
            {"report", {"report", "--minutes", "1440", "--out", "report"}, ""}};
        for (Job& job : all) job.endless = true;
        all.push_back({"mesh", {"mesh", scene, "--error", "0", "--out", "a.glb"}, "a.glb"});
        all.push_back({"centreline", {"centreline", "colon", "--no-cache", "--out", "a.vtp"}, "a.vtp"});
        all.push_back({"coverage", {"coverage", "colon", "--no-cache", "--out", "a.csv"}, "a.csv"});
        all.push_back({"info", {"info", scene, "--size", "8000x8000"}, ""});
        return all;
    }

    std::string ground() const {
        return grid("ground.asc", 500, 500, 30.0, [](int i, int j) { return 100 + (i * 37 + j * 91) % 50; });
    }

    // Returns jobs with all that a machine of today takes in a minute: 36 million heights, 134 million
    // voxels.
    std::vector<Job> largeJobs() const {
        const std::string scene = largeGround(), mask = largeVolume("mask.nrrd", true),
                          grey = largeVolume("grey.nrrd", false);
        std::vector<Job> all{
            {"render ground", {"render", scene, "--size", "8000x6000", "--out", "a.png"}, "a.png"},
            {"render volume", {"render", grey, "--size", "8000x6000", "--out", "a.png"}, "a.png"},
            {"render medium",
             {"render", grey, "--medium", "tissue", "--size", "3000x3000", "--out", "a.png"},
             "a.png"},
            {"play ground", {"play", scene, "--frames", "5000", "--out", "frames"}, "", true},
            {"play colon", {"play", mask, "--no-cache", "--frames", "5000", "--video", "a.mkv"}, "a.mkv"},
            {"mesh", {"mesh", scene, "--error", "0", "--out", "a.glb"}, "a.glb"},
            {"centreline", {"centreline", mask, "--no-cache", "--out", "a.vtp"}, "a.vtp"},
            {"bake openness", {"bake", scene, "--what", "openness", "--out", "a.light"}, ""},
            {"bake transfer", {"bake", scene, "--out", "b.light"}, ""},
            {"bake volume", {"bake", grey, "--samples", "100000", "--out", "a.bake"}, "", true},
            {"bake colon", {"bake", mask, "--no-cache", "--samples", "100000", "--out", "a.bake"}, "", true},
            {"compare ground", {"compare", scene, "--frames", "500", "--json", "a.json"}, "a.json"},
            {"compare colon",
             {"compare", mask, "--no-cache", "--frames", "500", "--json", "a.json"},
             "a.json"},
            {"info ground", {"info", scene}, ""},
            {"info colon", {"info", mask, "--no-cache"}, ""},
            {"report", {"report", "--minutes", "5", "--out", "report"}, ""}};
        if (!std::getenv("DISPLAY")) return all;
        all.push_back({"view ground", {"view", scene}, ""});
        all.push_back({"view colon", {"view", mask, "--no-cache"}, ""});
        all.push_back({"view medium", {"view", grey, "--medium", "tissue"}, ""});
        return all;
    }

    std::string largeGround() const {
        constexpr int kSide = 6000;
        std::vector<float> row(kSide);
        std::ofstream out(mFolder / "large.bil", std::ios::binary);
        for (int j = 0; j < kSide; ++j) {
            for (int i = 0; i < kSide; ++i)
                row[i] = static_cast<float>(1000 + 300 * std::sin(0.011 * i) * std::cos(0.017 * j) +
                                            (i * 37 + j * 91) % 50);
            out.write(reinterpret_cast<const char*>(row.data()),
                      static_cast<std::streamsize>(sizeof(float) * row.size()));
        }
        input("large.hdr",
              "BYTEORDER I\nLAYOUT BIL\nNROWS 6000\nNCOLS 6000\nNBANDS 1\nNBITS 32\n"
              "PIXELTYPE FLOAT\nXDIM 30\nYDIM 30\nULXMAP 0\nULYMAP 180000\n");
        return (mFolder / "large.bil").string();
    }

    // A winding tube in 512 x 512 x 512: a mask, or grey values that change everywhere.
    std::string largeVolume(const std::string& name, bool mask) const {
        constexpr int kSide = 512;
        const SmallStudy study{kSide, kSide, kSide, 0.8, mask ? "uchar" : "short", ""};
        std::ofstream out(mFolder / name, std::ios::binary);
        out << header(study);
        std::string slice;
        for (int k = 0; k < kSide; ++k) {
            slice.clear();
            const double x = 256 + 150 * std::sin(0.03 * k), y = 256 + 150 * std::cos(0.03 * k);
            for (int j = 0; j < kSide; ++j)
                for (int i = 0; i < kSide; ++i) {
                    const double away = std::hypot(i - x, j - y);
                    const bool inside = away < 25 && k > 5 && k < 506;
                    const int value = mask ? inside : static_cast<int>(1000 - 2 * away) + (i * j + k) % 30;
                    slice += static_cast<char>(value & 255);
                    if (!mask) slice += static_cast<char>(value >> 8 & 255);
                }
            out << slice;
        }
        return (mFolder / name).string();
    }

    static void note(const Job& job, double seconds, double taken_ms) {
        if (const char* file = std::getenv("STEREONAV_STOP_TABLE"))
            std::ofstream(file, std::ios::app) << job.name << '\t' << seconds << '\t' << taken_ms << '\n';
    }

    // Milliseconds until it ended; what it left is checked.
    double stopAfter(const Job& job, double seconds, int signal) const {
        for (const auto& entry : fs::directory_iterator(place())) fs::remove_all(entry.path());
        if (!job.old.empty()) std::ofstream(place() / job.old) << "old";
        const pid_t child = start(job.arguments);
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        const bool wasThere = catches(child, signal);
        const auto before = Clock::now();
        kill(child, signal);
        const Outcome outcome = awaitStopped(child);
        const double taken = std::chrono::duration<double, std::milli>(Clock::now() - before).count();
        if (outcome.status == 0 && !job.endless) return taken;  // it was done
        if (wasThere || outcome.status != -1) {
            EXPECT_EQ(outcome.status, 1) << outcome.err;
            EXPECT_NE(outcome.err.find("stopped"), std::string::npos) << outcome.err;
        }
        for (const auto& entry : fs::recursive_directory_iterator(place())) {
            EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
            if (entry.path() == place() / job.old)
                EXPECT_EQ(contentOf(entry.path()), "old");
            else
                EXPECT_TRUE(job.keeps) << entry.path() << " was left behind";
        }
        if (!job.old.empty()) {
            EXPECT_TRUE(fs::exists(place() / job.old));
        }
        return taken;
    }
};

TEST_F(Stop, EndsEveryCommandAndLeavesNothing) {
    for (const Job& job : jobs())
        for (const double seconds : {0.02, 0.3, 1.0}) {
            SCOPED_TRACE(job.name + " after " + std::to_string(seconds) + " s");
            note(job, seconds, stopAfter(job, seconds, SIGTERM));
        }
}

// Minutes, and gigabytes of memory and disk.
using StopNightly = Stop;
TEST_F(StopNightly, EndsEveryCommandWithLargeInputs) {
    for (const Job& job : largeJobs())
        for (const double seconds : {0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
            SCOPED_TRACE(job.name + " after " + std::to_string(seconds) + " s");
            note(job, seconds, stopAfter(job, seconds, SIGTERM));
        }
}

TEST_F(Stop, ByTheKeyboardIsTheSame) {
    stopAfter(jobs()[0], 0.3, SIGINT);
    stopAfter(jobs()[2], 0.3, SIGINT);
}

TEST_F(Stop, ByATerminalThatIsClosedIsTheSame) {
    stopAfter(jobs()[0], 0.3, SIGHUP);
}

// Nobody reads the other end of the pipe, which is full: the write never ends, the run does.
TEST_F(Stop, EndsARunThatNobodyListensTo) {
    const std::string pipe = (mFolder / "pipe.png").string();
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int other = open(pipe.c_str(), O_RDWR);
    const pid_t child = start({"render", ground(), "--size", "900x900", "--out", pipe});
    EXPECT_TRUE(waitFor([&] {
        constexpr int kPage = 4096;
        int held = 0;
        return ioctl(other, FIONREAD, &held) == 0 && held > fcntl(other, F_GETPIPE_SZ) - kPage;
    }));
    kill(child, SIGTERM);
    const Outcome outcome = awaitStopped(child);
    close(other);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "stereonav: stopped\n");
    EXPECT_TRUE(fs::is_fifo(pipe));
}

// Shells start jobs in the background like this: the keyboard belongs to another.
TEST_F(Stop, WhatWasIgnoredStaysIgnored) {
    const std::string frames = "'" + (mFolder / "frames").string() + "'";
    const std::string command = "trap '' INT; '" STEREONAV_PROGRAM "' play '" + ground() +
                                "' --size 400x300 --frames 20 --hash --out " + frames + " >'" +
                                (mFolder / "out").string() + "' & until [ -e " + frames +
                                "/frame_00000.png ]; do kill -0 $! || exit 2; sleep 0.01; done; "
                                "kill -INT $!; wait $!";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_NE(contentOf(mFolder / "out").find("hash "), std::string::npos);
}

}  // namespace
}  // namespace stereonav::test
