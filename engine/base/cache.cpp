#include "engine/base/cache.h"

#include <algorithm>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

struct Kept {
    fs::path file;
    std::uintmax_t bytes = 0;
    fs::file_time_type used;
};

// The last one used first. What vanishes meanwhile, by another process, is left out.
std::vector<Kept> keptFiles(const fs::path& folder) {
    std::vector<Kept> all;
    std::error_code code;
    for (fs::directory_iterator at(folder, code), end; !code && at != end; at.increment(code)) {
        const fs::path& file = at->path();
        if (file.extension() != ".bin" && file.extension() != ".nrrd") continue;
        std::error_code gone;
        const Kept kept{file, fs::file_size(file, gone), fs::last_write_time(file, gone)};
        if (!gone) all.push_back(kept);
    }
    std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used > b.used; });
    return all;
}

void makeRoom(const fs::path& justWritten, std::uintmax_t most) {
    std::error_code code;
    std::uintmax_t bytes = fs::file_size(justWritten, code);  // first: two times may be the same
    if (code) bytes = 0;
    for (const Kept& kept : keptFiles(justWritten.parent_path())) {
        if (kept.file == justWritten) continue;
        bytes += kept.bytes;
        if (bytes > most) fs::remove(kept.file, code);
    }
}

}  // namespace

fs::path keptFile(const std::string& name) {
    return cacheFolder() / name;
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

void noteUse(const fs::path& file) {
    std::error_code code;
    fs::last_write_time(file, fs::file_time_type::clock::now(), code);
}

}  // namespace stereonav
