#include "engine/base/own_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

constexpr mode_t kOthers = S_IRWXG | S_IRWXO;

// Returns what makes it no folder of ours; "" where it is one, or there is none.
std::string strangeness(const fs::path& folder) {
    struct stat is {};
    if (lstat(folder.c_str(), &is) != 0) return "";
    if (S_ISLNK(is.st_mode)) {
        if (is.st_uid != geteuid() && is.st_uid != 0) return "is a link that another user made";
        if (stat(folder.c_str(), &is) != 0) return "";
    }
    if (!S_ISDIR(is.st_mode)) return "";
    if (is.st_uid != geteuid()) return fmt::format("is a folder of another user (number {})", is.st_uid);
    if ((is.st_mode & kOthers) == 0 || chmod(folder.c_str(), S_IRWXU) == 0) return "";
    return std::string("others have rights on it that can not be taken away: ") + std::strerror(errno);
}

// 0, or the error as errno.
int made(const fs::path& folder) {
    for (bool first = true;; first = false) {
        if (mkdir(folder.c_str(), S_IRWXU) == 0)
            return chmod(folder.c_str(), S_IRWXU) == 0 ? 0 : errno;  // whatever the umask
        std::error_code code;
        if (errno == EEXIST) return fs::is_directory(folder, code) ? 0 : ENOTDIR;
        if (!first || errno != ENOENT || folder.parent_path() == folder) return errno;
        if (const int above = made(folder.parent_path()); above != 0) return above;
    }
}

}  // namespace

fs::path ownFolder(const char* variable, const char* besideHome) {
    if (const char* xdg = std::getenv(variable); xdg && *xdg == '/') return fs::path(xdg) / "stereonav";
    if (const char* home = std::getenv("HOME"); home && *home == '/')
        return fs::path(home) / besideHome / "stereonav";
    return {};
}

fs::path cachePlace() {
    fs::path own = ownFolder("XDG_CACHE_HOME", ".cache");
    if (!own.empty()) return own;
    std::error_code code;
    const fs::path temporary = fs::temp_directory_path(code);
    return (code ? fs::path("/tmp") : temporary) / fmt::format("stereonav-{}", geteuid());
}

void checkOwnFolder(const fs::path& folder, const std::string& advice) {
    if (const std::string strange = strangeness(folder); !strange.empty())
        throw Error(folder.string(), "", "is not used to keep files in: it " + strange, advice);
}

void makeOwnFolder(const fs::path& folder, const std::string& advice) {
    checkOwnFolder(folder, advice);
    if (const int reason = made(folder); reason != 0)
        throw Error(folder.string(), "",
                    fmt::format("can not be written: its folder can not be made ({})", std::strerror(reason)),
                    advice);
    checkOwnFolder(folder, advice);  // somebody may have been faster
}

fs::path cacheFolder() {
    fs::path folder = cachePlace();
    checkOwnFolder(folder, kMoveCache);
    return folder;
}

}  // namespace stereonav
