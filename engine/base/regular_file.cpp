#include "engine/base/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

Error unopened(const fs::path& file) {
    return {file.string(), "", "can not be opened", "check the name and its permissions"};
}

}  // namespace

// checkFileToRead() is called before opening too: only opening some devices already has an effect.
RegularFile::RegularFile(const fs::path& file) : mName(file) {
    checkFileToRead(file);
    mFile = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (mFile < 0) throw unopened(file);
    struct stat is {};
    if (fstat(mFile, &is) == 0 && S_ISREG(is.st_mode)) {
        mSize = static_cast<std::uint64_t>(is.st_size);
        return;
    }
    close(mFile);
    checkFileToRead(file);
    throw unopened(file);
}

RegularFile::~RegularFile() {
    close(mFile);
}

std::size_t RegularFile::read(void* to, std::size_t bytes) {
    std::size_t all = 0;
    while (all < bytes) {
        const ssize_t got = ::read(mFile, static_cast<char*>(to) + all, bytes - all);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw DiskError(mName.string());
        if (got == 0) break;
        all += static_cast<std::size_t>(got);
    }
    return all;
}

void RegularFile::seek(std::uint64_t byte) {
    if (lseek(mFile, static_cast<off_t>(byte), SEEK_SET) < 0) throw DiskError(mName.string());
}

std::string firstBytes(const fs::path& file, std::size_t bytes) {
    RegularFile in(file);
    std::string text(bytes, '\0');
    text.resize(in.read(text.data(), bytes));
    return text;
}

}  // namespace stereonav
