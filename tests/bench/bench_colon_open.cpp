// Opening studies as a user does: the whole program, from its start to the end of one picture of both eyes,
// with nothing in the cache and then from it; wall-clock medians, and the most memory held. Files may lie in
// the system's page cache all the time. bench_colon_open [STUDY ...]; without any: the generated colon, and
// the real one where it is found (STEREONAV_TEST_DATA or ../shared/data).
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/stopwatch.h"

extern char** environ;

namespace {
namespace fs = std::filesystem;

constexpr int kRuns = 5;

struct Opening {
    double seconds = 0, megabytes = 0;
    bool well = false;
};

fs::path program() {
    return fs::read_symlink("/proc/self/exe").parent_path() / "stereonav";
}

Opening open(const std::string& study, const fs::path& folder) {
    const std::string out = (folder / "out.png").string();
    std::vector<std::string> words{program().string(), "render", study, "--size", "500x400", "--out", out};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const stereonav::Stopwatch watch;
    Opening opening;
    pid_t child = 0;
    int status = 1;
    rusage usage{};
    if (posix_spawn(&child, argv[0], &files, nullptr, argv.data(), environ) == 0)
        wait4(child, &status, 0, &usage);
    posix_spawn_file_actions_destroy(&files);
    opening.seconds = watch.elapsed_ms() / 1000;
    opening.megabytes = static_cast<double>(usage.ru_maxrss) * 1024e-6;
    opening.well = status == 0 && fs::exists(out);
    return opening;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// cold: the cache is emptied before each run.
bool measure(const std::string& study, bool cold, const fs::path& folder) {
    std::vector<double> seconds, megabytes;
    for (int n = 0; n < kRuns; ++n) {
        if (cold) fs::remove_all(folder / "cache");
        const Opening opening = open(study, folder);
        if (!opening.well) {
            std::fprintf(stderr, "%s does not open\n", study.c_str());
            return false;
        }
        seconds.push_back(opening.seconds);
        megabytes.push_back(opening.megabytes);
    }
    std::printf("%-8s %7.2f s (%.2f to %.2f), at most %.0f MB\n", cold ? "cold" : "cached", median(seconds),
                *std::min_element(seconds.begin(), seconds.end()),
                *std::max_element(seconds.begin(), seconds.end()), median(megabytes));
    return true;
}

std::vector<std::string> usualStudies() {
    std::vector<std::string> studies{"colon"};
    const char* data = std::getenv("STEREONAV_TEST_DATA");
    const fs::path real =
        fs::path(data ? data : "../shared/data") / "colon/gca00020/large_intestine_mask_clean.nrrd";
    if (fs::exists(real)) studies.push_back(real.string());
    return studies;
}
}  // namespace

int main(int count, char** words) {
    std::vector<std::string> studies(words + 1, words + count);
    if (studies.empty()) studies = usualStudies();
    std::string folder = (fs::temp_directory_path() / "stereonav-open-XXXXXX").string();
    if (!mkdtemp(folder.data())) return 1;
    setenv("XDG_CACHE_HOME", (fs::path(folder) / "cache").c_str(), 1);
    bool well = true;
    for (const std::string& study : studies) {
        std::printf("%s: whole process of render --size 500x400, median of %d\n", study.c_str(), kRuns);
        well = measure(study, true, folder) && measure(study, false, folder) && well;
    }
    fs::remove_all(folder);
    return well ? 0 : 1;
}
