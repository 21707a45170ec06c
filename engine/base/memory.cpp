#include "engine/base/memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/memory_limit.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kAlwaysFits = 1e6;  // bytes that are not worth asking for

// The number after `name` in a file of lines "name number"; none: `otherwise`.
double valueIn(const fs::path& file, std::string_view name, double otherwise) {
    std::ifstream in(file);
    std::string word;
    for (double value = 0; in >> word; in.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
        if (word == name && in >> value) return value;
    return otherwise;
}

// A file of one number, or "max".
double numberIn(const fs::path& file) {
    std::ifstream in(file);
    double value = 0;
    return in >> value ? value : kUnlimited;
}

// Returns the memory that one group leaves; files that it has in memory are given back when asked for.
double leftOf(const fs::path& group, const char* limit, const char* used, const char* files) {
    const double most = numberIn(group / limit), now = numberIn(group / used);
    if (most == kUnlimited || now == kUnlimited) return kUnlimited;
    return std::max(0.0, most - now + valueIn(group / "memory.stat", files, 0));
}

// Version 2 has one tree, whose line begins with "0::"; version 1 one of memory.
double leftOfGroups(const fs::path& system) {
    const fs::path root = system / "sys/fs/cgroup";
    double left = kUnlimited;
    std::ifstream groups(system / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const bool second = line.starts_with("0::");
        if (!second && line.find(":memory:") == std::string::npos) continue;
        const fs::path top = second ? root : root / "memory";
        const fs::path name = fs::path(line.substr(line.rfind(':') + 1)).relative_path();
        fs::path group = name.empty() ? top : top / name;
        for (;; group = group.parent_path()) {  // a limit above counts too
            left = std::min(left, second ? leftOf(group, "memory.max", "memory.current", "inactive_file")
                                         : leftOf(group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                                  "total_inactive_file"));
            if (group == top || group == group.parent_path()) break;
        }
    }
    return left;
}

// Bytes of this process that no file backs.
double taken() {
    return 1024 * valueIn("/proc/self/status", "RssAnon:", 0);
}

// The limit in use: this program's own or, in a module, that of the program.
std::atomic<std::atomic<double>*>& limitUsed() {
    static std::atomic<double> own = 0;
    static std::atomic<std::atomic<double>*> used = &own;
    return used;
}

double leftOf(double limit) {
    return std::max(0.0, limit - taken());
}

// Bytes that are left of the user's own limits.
double leftOfWish() {
    const double limit = memoryLimit(), left = limit > 0 ? leftOf(limit) : kUnlimited;
    const char* text = std::getenv("STEREONAV_MEMORY");
    if (!text) return left;
    char* end = nullptr;
    const double most = std::strtod(text, &end);
    if (end == text || *end != '\0' || !(most >= 0))
        throw Error("STEREONAV_MEMORY", "", fmt::format("expected bytes, got \"{}\"", text), "2e9 are 2 GB");
    return std::min(left, leftOf(most));
}

// Writes only to a file that was opened for this before the program started: the program itself opens no file
// in this mode.
void noteAsked(double bytes) {
    const char* text = std::getenv("STEREONAV_MEMORY_ASKED");
    if (!text) return;
    int file = -1;
    const char* const textsEnd = text + std::strlen(text);
    const auto [end, failed] = std::from_chars(text, textsEnd, file);
    if (failed != std::errc() || end != textsEnd || file <= STDERR_FILENO) return;
    const int how = fcntl(file, F_GETFL);
    if (how < 0 || (how & O_ACCMODE) != O_WRONLY || !(how & O_APPEND)) return;
    const std::string line = fmt::format("{:.0f} {:.0f}\n", taken(), bytes);
    [[maybe_unused]] const ssize_t written = write(file, line.data(), line.size());
}

}  // namespace

std::atomic<double>& memoryLimit() {
    return *limitUsed().load();
}

void shareMemoryLimit(std::atomic<double>& program) {
    limitUsed() = &program;
}

void limitMemory(double bytes) {
    memoryLimit() = bytes;
}

double availableMemory(const fs::path& root) {
    const double kilobytes = valueIn(root / "proc/meminfo", "MemAvailable:", kUnlimited);
    return std::min({1024 * kilobytes, leftOfGroups(root), leftOfWish()});
}

double availableMemoryFor(double bytes) {
    noteAsked(bytes);
    return availableMemory();
}

std::string memoryText(double bytes) {
    return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

void checkMemory(const std::string& what, double bytes, const std::string& advice) {
    if (!(bytes > kAlwaysFits)) return;
    const double there = availableMemoryFor(bytes);
    if (bytes <= there) return;
    throw Error(what, "",
                fmt::format("needs {} of memory, and {} is available", memoryText(bytes), memoryText(there)),
                advice);
}

}  // namespace stereonav
