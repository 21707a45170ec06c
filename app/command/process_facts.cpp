#include "app/command/process_facts.h"

#include <fmt/format.h>
#include <malloc.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/base/module.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

struct Start {
    std::chrono::steady_clock::time_point main;
    double before_ms = 0;
};

const Start& start() {
    static const Start noted = [] {
        timespec used{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
        return Start{std::chrono::steady_clock::now(),
                     1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec)};
    }();
    return noted;
}

int threadsRunning() {
    std::error_code code;
    return static_cast<int>(std::distance(fs::directory_iterator("/proc/self/task", code), {}));
}

// Returns VmHWM of /proc/self/status, which is in kB there; 0 where the system does not report it.
std::size_t peakBytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::strtoull(line.c_str() + 6, nullptr, 10);
    return 0;
}

// Returns "gdal" for ".../lib/stereonav/stereonav_gdal.so".
std::vector<std::string> modulesAmong(const std::vector<std::string>& libraries) {
    constexpr const char* kPrefix = "stereonav_";
    std::vector<std::string> names;
    for (const fs::path file : libraries)
        if (const std::string stem = file.stem().string(); stem.rfind(kPrefix, 0) == 0)
            names.push_back(stem.substr(std::string(kPrefix).size()));
    return names;
}

}  // namespace

void noteStart() {
    start();
}

void takeWhenReady(ProcessFacts& facts) {
    const std::chrono::duration<double, std::milli> since = std::chrono::steady_clock::now() - start().main;
    facts.beforeMain_ms = start().before_ms;
    facts.ready_ms = since.count();
    const struct mallinfo2 heap = mallinfo2();
    facts.heapBytes = heap.uordblks + heap.hblkhd;
}

void takeAtEnd(ProcessFacts& facts) {
    facts.threads = threadsRunning();
    facts.peakBytes = peakBytes();
    facts.libraries = loadedLibraries();
    facts.modules = modulesAmong(facts.libraries);
}

Facts factsOf(const ProcessFacts& process) {
    const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
    const auto megabytes = [](std::size_t bytes) { return static_cast<double>(bytes) / 1e6; };
    return {factForJson("before_main_ms", process.beforeMain_ms, "ms"),
            factForJson("ready_ms", process.ready_ms, "ms"),
            factForText("start-up",
                        fmt::format("{:.1f} ms of processor time before main, scene ready after {:.0f} ms",
                                    process.beforeMain_ms, process.ready_ms)),
            factForAll("threads_running", std::int64_t{process.threads}, "threads",
                       fmt::format("{} running", process.threads)),
            factForJson("heap_bytes", count(process.heapBytes), "bytes"),
            factForJson("peak_bytes", count(process.peakBytes), "bytes"),
            factForText("libraries", fmt::format("{} loaded", process.libraries.size())),
            factForAll("modules", process.modules, "modules", process.modules.empty() ? "none" : ""),
            factForJson("libraries", process.libraries),
            factForText("memory", fmt::format("{:.1f} MB of heap with the scene, {:.1f} MB in all at most",
                                              megabytes(process.heapBytes), megabytes(process.peakBytes)))};
}

}  // namespace stereonav
