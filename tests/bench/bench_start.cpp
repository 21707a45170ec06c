// Starting the program: `--version`, whole processes by the clock.
// bench_start [PROGRAM]: the fastest and the median of many; PROGRAM is the one beside it when left out.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "engine/base/stopwatch.h"

namespace {

// Milliseconds of one run; negative where it failed.
double runOnce(const char* program) {
    const stereonav::Stopwatch watch;
    const pid_t child = fork();
    if (child == 0) {
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        execl(program, program, "--version", nullptr);
        _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? watch.elapsed_ms() : -1;
}

}  // namespace

int main(int argc, char** argv) {
    constexpr int kRuns = 100;
    const std::filesystem::path beside =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "stereonav";
    const char* program = argc > 1 ? argv[1] : beside.c_str();
    std::vector<double> times;
    for (int n = 0; n < kRuns; ++n) {
        times.push_back(runOnce(program));
        if (times.back() < 0) {
            std::fprintf(stderr, "bench_start: %s --version failed\n", program);
            return 1;
        }
    }
    std::sort(times.begin(), times.end());
    std::printf("%s --version: fastest %.2f ms, median %.2f ms of %d\n", program, times.front(),
                times[times.size() / 2], kRuns);
    return 0;
}
