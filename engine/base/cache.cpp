#include "engine/base/cache.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/own_folder.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSource = ".of";  // extension of notes

bool isLimited(const fs::path& file) {
    const fs::path kind = file.extension();
    return kind == ".bin" || kind == ".nrrd" || kind == ".tiles";
}

fs::path noteOf(const fs::path& file) {
    fs::path note = file;
    return note += kSource;
}

// The processes that may be writing a temporary, .STEM.PROCESS.XXXXXX.part.EXT, of older programs without
// XXXXXX, which may be a number too; none: it is no such file.
std::vector<pid_t> writersOf(const fs::path& file) {
    const std::string name = file.filename().string();
    std::vector<pid_t> writers;
    std::size_t end = name.starts_with('.') ? name.rfind(".part") : std::string::npos;
    for (int n = 0; n < 2 && end != std::string::npos && end > 0; ++n) {
        const std::size_t dot = name.rfind('.', end - 1);
        if (dot == std::string::npos || dot == 0) break;
        pid_t process = 0;
        const char* const last = name.data() + end;
        const auto [at, failed] = std::from_chars(name.data() + dot + 1, last, process);
        if (failed == std::errc() && at == last && process > 0) writers.push_back(process);
        end = dot;
    }
    return writers;
}

bool isGone(pid_t process) {
    return kill(process, 0) != 0 && errno == ESRCH;
}

fs::file_time_type timeOf(const struct stat& is) {
    return std::chrono::file_clock::from_sys(std::chrono::sys_time<std::chrono::nanoseconds>(
        std::chrono::seconds(is.st_mtim.tv_sec) + std::chrono::nanoseconds(is.st_mtim.tv_nsec)));
}

bool isOwnFile(const fs::path& file) {
    struct stat is {};
    return lstat(file.c_str(), &is) == 0 && S_ISREG(is.st_mode) && is.st_uid == geteuid();
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code code;
    for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code))
        files.push_back(at->path());
    return files;
}

fs::path sourceOf(const fs::path& file) {
    const fs::path note = noteOf(file);
    if (!isOwnFile(note)) return {};
    try {
        return readTextFile(note);
    } catch (const Error&) {
        return {};
    }
}

}  // namespace

fs::path keptFile(const std::string& name) {
    fs::path file = cacheFolder() / name;
    struct stat is {};
    if (lstat(file.c_str(), &is) == 0 && (S_ISLNK(is.st_mode) || is.st_uid != geteuid()))
        unlink(file.c_str());
    return file;
}

bool keep(const fs::path& file, const std::function<void(const fs::path&)>& write, std::uintmax_t most) {
    try {
        write(file);
    } catch (const Error&) {
        return false;
    }
    makeRoom(file, most);
    return true;
}

void makeRoom(const fs::path& justWritten, std::uintmax_t most) {
    removeLeftovers(justWritten.parent_path());
    std::error_code code;
    std::uintmax_t bytes = fs::file_size(justWritten, code);  // first: two times may be the same
    if (code) bytes = 0;
    for (const Kept& kept : allKept(justWritten.parent_path())) {
        if (kept.file == justWritten || !kept.limited) continue;
        bytes += kept.bytes;
        if (bytes > most) removeKept(kept.file);
    }
}

void noteUse(const fs::path& file) {
    std::error_code code;
    fs::last_write_time(file, fs::file_time_type::clock::now(), code);
}

void noteSource(const fs::path& file, const fs::path& source) {
    std::error_code code;
    fs::path whole = fs::canonical(source, code);
    if (code) return;
    if (file.parent_path() != cachePlace() || !isOwnFile(file) || sourceOf(file) == whole) return;
    try {
        writeTextFile(noteOf(file), whole.string(), Flush::ToSystem);
    } catch (const Error&) {  // then it is not known
    }
}

// Lists what is kept; what another process removes meanwhile is left out.
std::vector<Kept> allKept(const fs::path& folder) {
    std::vector<Kept> all;
    for (const fs::path& file : filesIn(folder)) {
        std::error_code code;
        if (file.extension() == kSource || !writersOf(file).empty() ||
            fs::is_directory(fs::symlink_status(file, code)))
            continue;
        struct stat is {};
        if (lstat(file.c_str(), &is) != 0) continue;
        Kept kept{file, static_cast<std::uintmax_t>(is.st_size), timeOf(is), {}, false};
        if (S_ISREG(is.st_mode)) kept.source = sourceOf(file), kept.limited = isLimited(file);
        all.push_back(std::move(kept));
    }
    std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used > b.used; });
    return all;
}

bool removeKept(const fs::path& file) {
    std::error_code code;
    fs::remove(file, code);
    if (code) return false;
    fs::remove(noteOf(file), code);
    return true;
}

int removeLeftovers(const fs::path& folder) {
    int removed = 0;
    std::error_code code;
    for (const fs::path& file : filesIn(folder)) {
        const std::vector<pid_t> writers = writersOf(file);
        if (!writers.empty()) {
            if (std::all_of(writers.begin(), writers.end(), isGone)) removed += fs::remove(file, code);
        } else if (file.extension() == kSource && !fs::exists(fs::path(file).replace_extension(), code)) {
            fs::remove(file, code);  // a note of nothing
        }
    }
    return removed;
}

}  // namespace stereonav
