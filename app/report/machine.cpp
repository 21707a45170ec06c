#include "app/report/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "app/scene/scene_loading.h"
#include "engine/base/parallel.h"
#include "engine/simd/simd_target.h"

// The commit, which CMake defines for this file only, when it configures.
#ifndef STEREONAV_COMMIT
#define STEREONAV_COMMIT "unknown"
#endif
#ifndef STEREONAV_LIBRARIES
#define STEREONAV_LIBRARIES "unknown"
#endif
#ifndef STEREONAV_BUILD
#define STEREONAV_BUILD "unknown"
#endif

namespace stereonav {
namespace {

std::string systemName() {
    utsname names{};
    return uname(&names) == 0 ? fmt::format("{} {} {}", names.sysname, names.release, names.machine)
                              : "unknown";
}

// Returns the widest instruction set that the program may use here, with which all figures are measured.
std::string instructionSetText() {
    const SimdTarget used = availableTarget(SimdTarget::Auto), widest = widestOfProcessor();
    std::string text(nameOf(used));
    if (used != widest) text += fmt::format(" (STEREONAV_SIMD hides {})", nameOf(widest));
    return text;
}

std::string memoryText() {
    const double bytes =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace

std::optional<double> loadAverage() {
    double load = 0;
    return getloadavg(&load, 1) == 1 ? std::optional(load) : std::nullopt;
}

std::string noiseWarning(std::optional<double> load, int processors) {
    constexpr double kBusyShare = 0.25;  // share of the processors that others used before the report began
    if (!load) return "How busy the machine was is not known: times may be noisy.";
    if (!(*load > kBusyShare * processors)) return "";
    return fmt::format(
        "A noisy machine: {:.2f} tasks were running on {} processors before the report began, so "
        "times are too long and spread; look at ratios within a chart.",
        *load, processors);
}

ReportFacts machineFacts() {
    const int processors = static_cast<int>(std::thread::hardware_concurrency());
    const std::optional<double> load = loadAverage();
    return {{"program", "stereonav " STEREONAV_BUILD},
            {"commit", STEREONAV_COMMIT},
            {"compiler", fmt::format("g++ or like it, {}", __VERSION__)},
            {"libraries", STEREONAV_LIBRARIES},
            {"processor", machineName()},
            {"instruction set", instructionSetText()},
            {"processors", std::to_string(processors)},
            {"memory", memoryText()},
            {"system", systemName()},
            {"threads", std::to_string(threadCount())},
            {"load at the start", load ? fmt::format("{:.2f}", *load) : "unknown"},
            {"date", fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)))}};
}

}  // namespace stereonav
