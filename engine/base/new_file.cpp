#include "engine/base/new_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace stereonav {
namespace fs = std::filesystem;
namespace {

bool isWrittenInto(const fs::path& place) {
    std::error_code code;
    switch (fs::status(place, code).type()) {
        case fs::file_type::fifo:
        case fs::file_type::character:
        case fs::file_type::block:
        case fs::file_type::socket:
            return true;
        default:
            return false;
    }
}

// number 1: the place itself.
fs::path numbered(const fs::path& wanted, int number) {
    if (number == 1) return wanted;
    fs::path place = wanted;
    return place.replace_filename(
        fmt::format("{}_{:04}{}", wanted.stem().string(), number, wanted.extension().string()));
}

// Makes it, unless something is there: then errno is EEXIST.
bool made(const fs::path& place, HeldPlace::Kind kind) {
    if (kind == HeldPlace::Kind::Folder) return mkdir(place.c_str(), 0777) == 0;
    const int file = open(place.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) return false;
    close(file);
    return true;
}

}  // namespace

fs::path freePlace(const fs::path& wanted) {
    if (isWrittenInto(wanted)) return wanted;
    for (int number = 1;; ++number) {
        std::error_code code;
        fs::path place = numbered(wanted, number);
        if (!fs::exists(fs::symlink_status(place, code))) return place;
    }
}

HeldPlace::HeldPlace(const fs::path& wanted, Kind kind) : mPath(wanted), mKind(kind) {
    if (isWrittenInto(wanted)) return;
    std::error_code code;
    if (kind == Kind::Folder && fs::is_directory(wanted, code) && fs::is_empty(wanted, code)) return;
    for (int number = 1; !mHolds; ++number) {
        mPath = numbered(wanted, number);
        mHolds = made(mPath, kind);
        if (!mHolds && errno != EEXIST) return;
    }
}

HeldPlace::~HeldPlace() {
    if (!mHolds) return;
    std::error_code code;
    if (mKind == Kind::Folder)
        rmdir(mPath.c_str());  // an empty one alone
    else if (fs::is_regular_file(mPath, code) && fs::file_size(mPath, code) == 0)
        fs::remove(mPath, code);
}

}  // namespace stereonav
