#include "engine/base/files_read.h"

#include <sys/stat.h>

#include <cerrno>
#include <mutex>
#include <set>
#include <utility>

namespace stereonav {
namespace {

struct FilesRead {
    std::mutex mutex;
    std::set<std::pair<dev_t, ino_t>> files;

    // Never destroyed: libraries open files until the very end.
    static FilesRead& instance() {
        static FilesRead& all = *new FilesRead;
        return all;
    }
};

}  // namespace

void noteFileRead(int file) {
    struct stat is {};
    const int before = errno;  // the library that opened the file may still read errno
    if (fstat(file, &is) == 0 && S_ISREG(is.st_mode)) {
        FilesRead& all = FilesRead::instance();
        const std::lock_guard lock(all.mutex);
        all.files.emplace(is.st_dev, is.st_ino);
    }
    errno = before;
}

bool wasFileRead(const std::filesystem::path& path) {
    struct stat is {};
    if (stat(path.c_str(), &is) != 0) return false;
    FilesRead& all = FilesRead::instance();
    const std::lock_guard lock(all.mutex);
    return all.files.contains({is.st_dev, is.st_ino});
}

void forgetFileRead(const std::filesystem::path& path) {
    struct stat is {};
    if (stat(path.c_str(), &is) != 0) return;
    FilesRead& all = FilesRead::instance();
    const std::lock_guard lock(all.mutex);
    all.files.erase({is.st_dev, is.st_ino});
}

}  // namespace stereonav
