// Runs the real program as a user does, and catches what it prints.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/own_cache.h"
#include "tests/support/wait_for.h"

namespace stereonav::test {

struct Outcome {
    int status = -1;  // exit status; -1 when it did not end by itself
    std::string out, err;
};

inline std::string contentOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
}

inline long linesIn(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
}

// A folder of its own for each test; the program runs in its subfolder `place`, so that what is left
// behind can be listed.
class ProgramTest : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "stereonav_app_XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        mFolder = pattern;
        std::filesystem::create_directory(place());
        useOwnCache();
    }
    void TearDown() override { std::filesystem::remove_all(mFolder); }

    std::filesystem::path place() const { return mFolder / "place"; }

    // Writes an input file outside `place` and gives its full name.
    std::string input(const std::string& name, const std::string& content) const {
        std::ofstream(mFolder / name, std::ios::binary) << content;
        return (mFolder / name).string();
    }

    Outcome run(const std::vector<std::string>& arguments) const { return await(start(arguments)); }

    pid_t start(const std::vector<std::string>& arguments) const {
        const pid_t child = fork();
        if (child == 0) {
            execIn(arguments, mFolder / "stdout", mFolder / "stderr");
            _exit(127);
        }
        return child;
    }

    Outcome await(pid_t child) const {
        int status = 0;
        waitpid(child, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(mFolder / "stdout"),
                contentOf(mFolder / "stderr")};
    }

    // Returns what became of it after it was told to end: however busy the machine is, it does.
    Outcome awaitStopped(pid_t child) const {
        EXPECT_TRUE(waitFor([&] { return hasEnded(child); })) << "it was told to end, and goes on";
        if (!hasEnded(child)) kill(child, SIGKILL);
        return await(child);
    }
    static bool hasEnded(pid_t child) {  // await() is still to be called
        siginfo_t ended{};
        return waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
               ended.si_pid == child;
    }
    // Returns whether the program handles the signal by now: before that it ends as any program does.
    static bool catches(pid_t child, int signal) {
        std::ifstream status("/proc/" + std::to_string(child) + "/status");
        for (std::string line; std::getline(status, line);)
            if (line.rfind("SigCgt:", 0) == 0)
                return std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1;
        return false;
    }
    // Waits until it handles SIGINT, and has used so much processor time: it is in the middle of its work.
    static void awaitWork(pid_t child, double seconds) {
        const auto used = [&] {
            clockid_t clock{};
            timespec time{};
            if (clock_getcpuclockid(child, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0.0;
            return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
        };
        ASSERT_TRUE(waitFor([&] { return hasEnded(child) || (catches(child, SIGINT) && used() > seconds); }));
        ASSERT_FALSE(hasEnded(child)) << "it ended by itself";
    }

    // Expects exit status 1, one line on stderr that holds every one of `words`, nothing on stdout, and
    // nothing left in `place`.
    void expectRefused(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& words) const {
        std::string command;
        for (const std::string& argument : arguments) command += " " + argument;
        SCOPED_TRACE("stereonav" + command);
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_EQ(linesIn(outcome.err), 1) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("stereonav: ", 0), 0u) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        for (const std::string& word : words)
            EXPECT_NE(outcome.err.find(word), std::string::npos)
                << "no \"" << word << "\" in: " << outcome.err;
        EXPECT_TRUE(std::filesystem::is_empty(place())) << "something was left behind";
    }

    // An ESRI ASCII grid; `value` gives sample (i, j), row 0 northernmost, as text.
    template <typename Value>
    std::string grid(const std::string& name, int width, int height, double spacing, Value value) const {
        std::ostringstream text;
        text << "ncols " << width << "\nnrows " << height << "\nxllcorner 0\nyllcorner 0\ncellsize "
             << spacing << "\nNODATA_value -9999\n";
        for (int j = 0; j < height; ++j) {
            for (int i = 0; i < width; ++i) text << value(i, j) << ' ';
            text << '\n';
        }
        return input(name, text.str());
    }

    // Hills of 32 x 24 samples that every command can fly over.
    std::string hills() const {
        return grid("hills.asc", 32, 24, 30.0, [](int i, int j) { return 100 + (i * 37 + j * 91) % 50; });
    }

    std::filesystem::path mFolder;

private:
    void execIn(const std::vector<std::string>& arguments, const std::filesystem::path& out,
                const std::filesystem::path& err) const {
        const int outFile = open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        const int errFile = open(err.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        if (outFile < 0 || errFile < 0 || chdir(place().c_str()) != 0) return;
        signal(SIGINT, SIG_DFL);   // a shell has it ignored by what it runs in the background
        signal(SIGXFSZ, SIG_DFL);  // a test that limits files ignores it, a shell does not
        // Lines of progress are of runs that take long, which depends on the machine.
        setenv("STEREONAV_PROGRESS_SECONDS", "1000000", 0);
        dup2(outFile, STDOUT_FILENO);
        dup2(errFile, STDERR_FILENO);
        std::vector<char*> argv{const_cast<char*>(STEREONAV_PROGRAM)};
        for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        execv(STEREONAV_PROGRAM, argv.data());
    }
};

}  // namespace stereonav::test
